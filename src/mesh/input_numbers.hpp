#pragma once

#include <gale/export.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale {

/// What users call the simplices of a dimension 0 to 3, by GALE's id, on the host. Vertices and cells have their places
/// in the input; an edge, and a triangle that is no cell, has its place among all of the mesh, each written with its
/// input vertices ascending, in lexicographic order. So the numbers depend on nothing but the input.
///
/// Edges and triangles are enumerated if they haven't been, and numbered: O(n), O(n log n) at vertices and edges of
/// very many. On the host each vertex numbers those of which it has the least input id, in 16 bytes a vertex and 4 for
/// some of the simplices; a device sorts all, in 16 bytes each of its memory.
GALE_EXPORT Array<const Id, HostMemory> input_numbers(const Mesh& mesh, int dimension);

/// The numbers of all edges and of all triangles, by GALE's ids.
struct InputNumbers {
  Array<const Id, HostMemory> edges;      ///< GALE's id of an edge -> its number
  Array<const Id, HostMemory> triangles;  ///< GALE's id of a triangle -> its number
};

namespace detail {

/// The numbers of edges and triangles, where they were made; empty of what wasn't wanted.
struct MadeNumbers {
  Mirrored<Id> edges, triangles;
};

/// Numbers the edges, the triangles (of a mesh of tetrahedra), or both.
GALE_EXPORT MadeNumbers make_numbers(const Mesh& mesh, bool edges, bool triangles);

}  // namespace detail

/// Numbers all edges and all triangles, which takes less time than one after the other.
GALE_EXPORT InputNumbers input_numbers(const Mesh& mesh);

}  // namespace gale
