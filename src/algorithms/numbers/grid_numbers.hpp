#pragma once

#include <gale/algorithms/simplex_numbers.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale::detail {

/// Numbers simplices of a grid, whole or with a mask: what number_simplices does, by arithmetic. Which cubes are around
/// a vertex says which edges and triangles it is the first vertex of, and in which order; where the others lie from it
/// says which of these is meant.
SimplexNumbers number_on_grid(const Mesh& mesh, const NamedSimplices& named);

}  // namespace gale::detail
