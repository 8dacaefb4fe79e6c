#pragma once

#include <gale/base/parallel.hpp>
#include <gale/runtime/device_sweep.hpp>

namespace gale {

/// A whole relation: the row of simplex i is entries[row_map[i]] to entries[row_map[i + 1] - 1], ascending. As
/// Kokkos-Kernels and others take graphs.
template <class Memory>
struct Graph {
  Array<const Offset, Memory> row_map;  ///< where each row begins, and the end of the last
  Array<const Id, Memory> entries;      ///< GALE's ids, row after row
};

namespace detail {

/// Where GALE's own functors run, which may share a host with any threads: on all of its threads.
template <class Space>
auto with_all_threads(const Space& space) {
  if constexpr (is_device<Space>) {
    return space;
  } else {
    space.fence();
    return HostThreads();
  }
}

template <class Memory>
struct CountEntries {
  Array<Offset, Memory> sizes;
  KOKKOS_FUNCTION void operator()(Id simplex, const Row& row) const { sizes(simplex) = row.size(); }
  KOKKOS_FUNCTION Offset operator()(Offset simplex) const { return sizes(simplex); }
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

/// Makes a relation of all simplices at once, in the memory of `space`; what is said of sweeps (device_sweep.hpp)
/// holds. On the host all threads make it, whatever the space. Rows are made twice, to be counted and to be copied, so
/// that nothing else takes memory: 8 bytes a row, 4 an entry. Rows of simplices that have ghosts alone are empty.
/// Throws OutOfMemory where the memory isn't there.
template <class Space>
Graph<detail::MemoryOfSweep<Space>> graph_of(const Space& space, const Mesh& mesh, Relation relation,
                                             const DeviceSweepOptions& options = {}) {
  using Memory = detail::MemoryOfSweep<Space>;
  mesh.simplices<Memory>(needs_of(relation));
  const auto all = detail::with_all_threads(space);
  const Offset rows = mesh.interval_begin(row_dimension(relation))(mesh.segments());
  const auto begin = allocate<Array<Offset, Memory>>("GALE::graph_row_map", rows + 1);
  if (mesh.owned_segments() < mesh.segments()) Kokkos::deep_copy(begin, Offset(0));
  const detail::CountEntries<Memory> count{begin};
  for_each_row(all, mesh, relation, count, options);
  const Offset total = exclusive_scan("GALE::graph_row_map", all, rows, begin, count);
  const auto entries = allocate<Array<Id, Memory>>("GALE::graph_entries", total);
  for_each_row(all, mesh, relation, detail::CopyEntries<Memory>{begin, entries}, options);
  return {begin, entries};
}

}  // namespace gale
