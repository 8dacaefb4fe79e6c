#pragma once

#include <gale/base/parallel.hpp>
#include <gale/runtime/device_sweep.hpp>
#include <gale/runtime/relation_of.hpp>

namespace gale {

namespace detail {

template <class Memory>
struct CountEntries {
  Array<Offset, Memory> sizes;
  KOKKOS_FUNCTION void operator()(Id simplex, const Row& row) const { sizes(simplex) = row.size(); }
};

template <class Memory>
struct CopyEntries {
  Array<Offset, Memory> begin;
  Array<Id, Memory> entries;
  KOKKOS_FUNCTION void operator()(Id simplex, const Row& row) const {
    Id* const to = entries.data() + begin(simplex);
    for (Id i = 0; i < row.size(); ++i) to[i] = row[i];
  }
};

}  // namespace detail

/// Makes a relation of all simplices at once, in the memory of `space` and in GALE's ids: the row of each simplex,
/// ascending. On the host it is relation_of on all threads, whatever the space. What is said of sweeps
/// (device_sweep.hpp) holds on a device; there rows are made twice, to be counted and to be copied, so that nothing
/// else takes memory: 8 bytes a row, 4 an entry. Rows of simplices that have ghosts alone are empty. Throws OutOfMemory
/// where the memory isn't there.
template <class Space>
Csr<const Id, detail::MemoryOfSweep<Space>> graph_of(const Space& space, const Mesh& mesh, Relation relation,
                                                     const DeviceSweepOptions& options = {}) {
  if constexpr (is_device<Space>) {
    using Memory = detail::MemoryOfSweep<Space>;
    mesh.simplices<Memory>(needs_of(relation, mesh.dimension()));
    const Offset rows = mesh.interval_begin(row_dimension(relation))(mesh.segments());
    const auto offsets = allocate<Array<Offset, Memory>>("GALE::graph_offsets", rows + 1);
    if (mesh.owned_segments().size() < mesh.segments()) Kokkos::deep_copy(offsets, Offset(0));
    for_each_row(space, mesh, relation, detail::CountEntries<Memory>{offsets}, options);
    const Offset total = exclusive_scan("GALE::graph_offsets", space, rows, offsets, offsets);
    const auto entries = allocate<Array<Id, Memory>>("GALE::graph_entries", total);
    for_each_row(space, mesh, relation, detail::CopyEntries<Memory>{offsets, entries}, options);
    return {offsets, entries};
  } else {
    space.fence();
    return relation_of(mesh, relation, Ids::gale);
  }
}

}  // namespace gale
