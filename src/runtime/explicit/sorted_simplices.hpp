#pragma once

#include <gale/mesh/mesh.hpp>
#include <gale/relations/relation.hpp>
#include <gale/runtime/whole/even_rows.hpp>

// The simplices of a whole mesh and what bounds them, by sorting what all tetrahedra have. It shares no code with the
// enumeration of `Mesh`, which is tested against it.

namespace gale::detail {

/// The edges or the triangles of a mesh. A tetrahedron's places are its six edges or its four triangles, in
/// lexicographic order; those of tetrahedron t follow those of t - 1.
struct SortedSimplices {
  EvenRows<WorkerMemory> of_tetrahedra;     ///< TE or TF: the number of the simplex at each place
  Array<const Id, WorkerMemory> any_place;  ///< simplex -> one of the places where it is

  Id count() const { return static_cast<Id>(any_place.extent(0)); }
};

/// TV: the mesh's own array.
EvenRows<WorkerMemory> tetrahedron_vertices(const Mesh& mesh);

/// Numbers the simplices in the lexicographic order of their vertices, in the workers' space. O(n). For the edges it
/// takes 144 bytes a tetrahedron while it works and leaves 24, and 4 an edge; for the triangles 96, 16 and 4. Throws
/// gale::Error if TE, or TF, has more entries than an Id counts.
SortedSimplices number_edges(const EvenRows<WorkerMemory>& tv);
SortedSimplices number_triangles(const EvenRows<WorkerMemory>& tv, const EvenRows<WorkerMemory>& te);

/// EV, FV or FE: what bounds each simplex, from a tetrahedron that has it. Throws gale::Error if that has more entries
/// than an Id counts.
EvenRows<WorkerMemory> faces(Relation relation, const SortedSimplices& simplices,
                             const EvenRows<WorkerMemory>& of_tetrahedra);

/// Where the edges, or triangles, that are internal to each segment begin, and one past the last; on the host.
/// `dimension` is theirs.
Array<const Id, HostMemory> segment_begin(const Mesh& mesh, int dimension, const SortedSimplices& simplices);

}  // namespace gale::detail
