#pragma once

#include <gale/export.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale {

/// What users call the simplices of a dimension 0 to 3, by GALE's id, on the host. Vertices and tetrahedra have their
/// places in the input; an edge or a triangle has its place among all of the mesh, each written with its input vertices
/// ascending, in lexicographic order. So the numbers depend on nothing but the input.
///
/// Edges and triangles are enumerated if they haven't been, and sorted: O(n), O(n log n) at vertices and edges of very
/// many; 16 bytes each in the workers' memory meanwhile.
GALE_EXPORT Array<const Id, HostMemory> input_numbers(const Mesh& mesh, int dimension);

}  // namespace gale
