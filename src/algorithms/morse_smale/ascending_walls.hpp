#pragma once

#include <gale/algorithms/morse_smale.hpp>

namespace gale::detail {

/// The ascending walls of all critical edges. A wall goes on from an edge, through each of the edge's triangles, to the
/// edge that the triangle is paired with. Its critical edge comes first, the others by their vertices' input ids. Reads
/// VT of `structure`.
AscendingWalls ascending_walls(Structure& structure, const DiscreteGradient& gradient, int threads);

}  // namespace gale::detail
