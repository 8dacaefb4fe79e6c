#pragma once

#include <cstdint>

namespace gale::io::detail {

/// The six tetrahedra of a cube, along its main diagonal. Corners are numbered by their coordinates: bit 0 is x, bit 1
/// y, bit 2 z. Each tetrahedron walks from corner 0 to corner 7 along the axes in one of the orders xyz, xzy, yxz, yzx,
/// zxy, zyx.
inline constexpr int tetrahedra_per_cube = 6;
inline constexpr std::uint8_t freudenthal[tetrahedra_per_cube][4] = {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7},
                                                                     {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}};

}  // namespace gale::io::detail
