#pragma once

#include <gale/algorithms/morse_smale.hpp>

namespace gale::detail {

/// Of each critical edge: from an edge through each of its triangles to the edge that the triangle is paired with; the
/// critical edge first, the others by their vertices' input ids. Reads VT of `structure`.
AscendingWalls ascending_walls(Structure& structure, const DiscreteGradient& gradient, int threads);

}  // namespace gale::detail
