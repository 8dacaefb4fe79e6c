#pragma once

#include <array>
#include <string>

#include <gale/base/csr.hpp>
#include <gale/mesh/mesh.hpp>
#include <gale/relations/relation.hpp>
#include <gale/relations/rows.hpp>
#include <gale/relations/segment_rows.hpp>
#include <gale/runtime/whole/whole_rows.hpp>

namespace gale::detail {

/// Relations of a whole mesh, on the host, as the explicit structure keeps them.
struct ExplicitRelations {
  std::array<Csr<const Id, HostMemory, Id>, relation_count>
      kept;  ///< what is wanted; of VT or VF at least the offsets for links

  int dimension = 3;  ///< of the mesh
  Array<std::uint8_t, HostMemory> link_places;
  int link_width = 1;  ///< bytes of a place

  /// By dimension: how many simplices there are, and where those that are internal to each segment begin, and one past
  /// the last. no_id and empty for edges and triangles that nothing wanted.
  std::array<Id, 4> count{no_id, no_id, no_id, no_id};
  std::array<Array<const Id, HostMemory>, 4> segment_begin;

  /// All rows of a relation.
  Rows rows(Relation relation) const {
    const auto& all = kept[static_cast<int>(relation)];
    return {0, static_cast<Id>(all.rows()), all.offsets.data(), all.entries.data()};
  }

  /// The links of all vertices.
  LinkRows links() const {
    const Rows stars = rows(vertex_cells(dimension));
    return {0, stars.count, stars.offsets, link_places.data(), link_width, dimension};
  }

  /// Rows of the simplices given; those of all lie together, so there is nothing to compute.
  SegmentRows rows(RelationSet wanted, Id segment, const Intervals& simplices) const {
    SegmentRows some(segment, simplices);
    for (const Relation relation : members_of(wanted)) some.set(relation, rows(relation));
    if (wanted.has_links()) some.set(links());
    return some;
  }

  Intervals intervals_of(Id segment) const {
    Intervals intervals;
    for (int d = 0; d < 4; ++d) {
      const auto& begin = segment_begin[d];
      if (begin.extent(0) != 0) intervals[d] = {begin(segment), begin(segment + 1)};
    }
    return intervals;
  }

  /// All simplices.
  Intervals intervals() const {
    Intervals intervals;
    for (int d = 0; d < 4; ++d) {
      if (count[d] != no_id) intervals[d] = {0, count[d]};
    }
    return intervals;
  }
};

/// Computes all rows of the relations wanted, one relation after another, in the workers' space. What only others are
/// computed from goes when the last of them is there. Throws gale::Error if a relation on the way has more entries than
/// an Id counts, before it takes memory for them; and where GALE was built without Kokkos-Kernels.
ExplicitRelations explicit_relations(const Mesh& mesh, RelationSet wanted);

// What Kokkos-Kernels computes, in the workers' space.

/// Throws gale::Error where GALE was built without Kokkos-Kernels. So do the two that follow.
void require_kokkos_kernels();

/// The coboundary XY from its faces YX: its transpose. Rows ascend. `rows`: how many X there are.
Csr<const Id, WorkerMemory> transpose(Relation relation, const Csr<const Id, WorkerMemory>& faces, Id rows);

/// The adjacency XX from XY and YX: which X share a Y, none of them with itself. Rows ascend. While it works it takes 4
/// bytes an entry, 16 a row and what Kokkos-Kernels hashes with beside the result. Throws gale::Error if it has more
/// entries than an Id counts, before it takes memory for them.
Csr<const Id, WorkerMemory> neighbours(Relation relation, const Csr<const Id, WorkerMemory>& xy,
                                       const Csr<const Id, WorkerMemory>& yx);

/// "GALE::VV": what kernels and arrays of a relation are called.
std::string label_of(Relation relation);

/// Throws gale::Error, naming both, if a relation's entries are more than an Id counts.
void require_countable(Relation relation, Offset entries);

// The simplices of a whole mesh and what bounds them, by sorting what all cells have. It shares no code with the
// enumeration of `Mesh`, which is tested against it.

/// The edges or the triangles of a mesh. A cell's places are its six edges or its four triangles (a triangle's three
/// edges), in lexicographic order; those of cell t follow those of t - 1.
struct SortedSimplices {
  EvenRows<WorkerMemory> of_cells;          ///< TE or TF (FE): the number of the simplex at each place
  Array<const Id, WorkerMemory> any_place;  ///< simplex -> one of the places where it is

  Id count() const { return static_cast<Id>(any_place.extent(0)); }
};

/// TV, the mesh's own array, or FV on triangle meshes.
EvenRows<WorkerMemory> cell_vertices(const Mesh& mesh);

/// Numbers the simplices in the lexicographic order of their vertices, in the workers' space. O(n). For the edges it
/// takes 144 bytes a tetrahedron while it works and leaves 24, and 4 an edge; for the triangles 96, 16 and 4. Throws
/// gale::Error if TE, or TF, has more entries than an Id counts.
SortedSimplices number_edges(const EvenRows<WorkerMemory>& cell_vertices);
SortedSimplices number_triangles(const EvenRows<WorkerMemory>& tv, const EvenRows<WorkerMemory>& te);

/// EV, FV or FE: what bounds each simplex, from a cell that has it. Throws gale::Error if that has more entries
/// than an Id counts.
EvenRows<WorkerMemory> faces(Relation relation, const SortedSimplices& simplices,
                             const EvenRows<WorkerMemory>& of_cells);

/// Where the edges, or triangles, that are internal to each segment begin, and one past the last; on the host.
/// `dimension` is theirs.
Array<const Id, HostMemory> segment_begin(const Mesh& mesh, int dimension, const SortedSimplices& simplices);

}  // namespace gale::detail
