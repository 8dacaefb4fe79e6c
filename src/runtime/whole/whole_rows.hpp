#pragma once

#include <functional>

#include <gale/base/csr.hpp>
#include <gale/base/parallel.hpp>
#include <gale/mesh/mesh.hpp>
#include <gale/relations/faces.hpp>
#include <gale/relations/relation.hpp>
#include <gale/runtime/structure.hpp>
#include <gale/runtime/sweep_options.hpp>

// Relations of a whole mesh, for the host, each found in the way that is fastest for it.

namespace gale::detail {

/// A relation to faces, all of whose rows have as many entries: row i is entries(length * i) to
/// entries(length * (i + 1) - 1). It has no offsets, which would take 8 bytes a row.
template <class Memory>
struct EvenRows {
  int length = 0;
  Array<const Id, Memory> entries;

  const Id* row(Offset i) const { return entries.data() + length * i; }
  Id rows() const { return length == 0 ? 0 : static_cast<Id>(entries.extent(0) / length); }
};

template <class Offsets>
struct WriteEvenOffset {
  Offsets offsets;
  int length;
  KOKKOS_FUNCTION void operator()(Offset i) const {
    offsets(i) = static_cast<typename Offsets::value_type>(length * i);
  }
};

/// Adds the offsets, on `space`, which works in that memory.
template <class Index = Offset, class Space, class Memory>
Csr<const Id, Memory, Index> with_offsets(const Space& space, const EvenRows<Memory>& even) {
  const auto offsets = allocate<Array<Index, Memory>>("GALE::row_begin", even.rows() + Offset(1));
  parallel_for("GALE::row_begin", space, even.rows() + Offset(1),
               WriteEvenOffset<Array<Index, Memory>>{offsets, even.length});
  return {offsets, even.entries};
}

/// What a relation's rows and its entries are called, by GALE's ids.
struct RelationNames {
  const Id *rows = nullptr, *entries = nullptr;
};

/// Gives the names of a relation's simplices, when these have been enumerated.
using NamesOf = std::function<RelationNames(Relation)>;

/// How many simplices of a dimension the mesh has.
inline Id count_of(const Mesh& mesh, int dimension) { return mesh.interval_begin(dimension)(mesh.segments()); }

/// Writes a row's ids, no two of them alike, in ascending order: each where as many are smaller. No step waits for a
/// branch, nor for ids that were put into memory one by one and are read several at once.
template <int size>
KOKKOS_INLINE_FUNCTION void write_ascending(const FaceRow<size>& row, Id* to) {
  for (int i = 0; i < size; ++i) {
    int smaller = 0;
    for (int k = 0; k < size; ++k) smaller += row.ids[k] < row.ids[i] ? 1 : 0;
    to[smaller] = row.ids[i];
  }
}

/// A whole relation to faces, or the one the other way round, by kernels of `space`: what a device does. `names` are in
/// its memory; null where GALE's ids stay. Beside the mesh's tables it takes 4 bytes an entry there, for the other way
/// round 8, and 8 a row. No rows are left out.
template <class Space>
Csr<const Id, HostMemory> kernel_rows(const Space& space, const Mesh& mesh, Relation to_faces, bool transposed,
                                      const RelationNames& names);

/// A whole relation to faces: looked up in the tables of the mesh's simplices, which it enumerates as far as that
/// takes, and written where it stays.
EvenRows<HostMemory> face_rows(const Mesh& mesh, Relation relation, const NamesOf& names_of,
                               const SweepOptions& options);

/// The relation the other way round: for each of so many faces the simplices that have it. Each thread counts and
/// places those of a part of the simplices, so that they ascend. Beside the result it takes 4 bytes for each face from
/// the least to the greatest of a part; there are so few parts that this is no more than twice the entries' memory.
Csr<const Id, HostMemory> transposed_rows(const EvenRows<HostMemory>& faces, Id face_count, int threads);

/// The simplices that share a face with each: those that `cofaces` has for its two or three faces, without itself. Two
/// share one face at most.
Csr<const Id, HostMemory> joined_rows(const EvenRows<HostMemory>& faces, const Csr<const Id, HostMemory>& cofaces,
                                      const SweepOptions& options);

/// A whole relation in one sweep. Each row is written to a place of its own as soon as it is there; when all sizes are
/// known, the rows are moved together in the same memory. So there is one copy of nearly all entries, and pages that
/// are touched once.
Csr<const Id, HostMemory> swept_rows(Structure& structure, Relation relation, const RelationNames& names,
                                     const SweepOptions& options);

}  // namespace gale::detail
