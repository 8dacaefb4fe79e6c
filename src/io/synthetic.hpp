#pragma once

#include <gale/export.hpp>
#include <gale/io/dataset.hpp>

namespace gale::io {

/// The Freudenthal mesh of n^3 points at whole coordinates 0..n-1, with one array `field` (float): the input `grid:n`
/// of the command.
///
/// Vertex i = (z*n + y)*n + x. With c = n-1, the cube at (x, y, z) holds the tetrahedra ((z*c + y)*c + x)*6 + p, p =
/// 0..5, each as a walk from its lowest to its highest corner, along the axes in the orders xyz, xzy, yxz, yzx, zxy,
/// zyx; so half of them are oriented negatively. The field is float(sin(0.11x)cos(0.13y) + sin(0.17z + 0.05x) +
/// 0.05*h(i)/2^32), computed in double, with h a hash of 32 bits.
///
/// Runs on all host threads. Throws `Error` if n < 2, or if the vertices or tetrahedra do not fit 32-bit ids (n > 711).
GALE_EXPORT Dataset make_grid(int n);

}  // namespace gale::io
