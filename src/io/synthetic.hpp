#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <gale/export.hpp>
#include <gale/io/dataset.hpp>
#include <gale/mesh/intervals.hpp>

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
GALE_EXPORT Dataset make_grid(int n, GridCells cells = GridCells::written);

/// The triangle mesh of n^2 points at whole coordinates (x, y, 0), with one array `field` (float): the input `plane:n`
/// of the command. Vertex i = y*n + x; the square at a = (x, y) holds the triangles (a, a+1, a+n+1) and (a, a+n,
/// a+n+1), x fastest. The field is make_grid's at z = 0, with this i. Throws `Error` if n < 2, or if the triangles do
/// not fit 32-bit ids (n > 32768).
GALE_EXPORT Dataset make_plane(int n, GridCells cells = GridCells::written);

/// Whether there is a synthetic mesh of that kind: meshes of other character than the grid's, for measurements, the
/// inputs `smooth:N`, `noisy:N`, `ball:N`, `shells:N` and `dense:N` of the command. Each has points of a cube of n^3
/// and one array `field`, above 0:
/// - `smooth`: all points; few waves, and few critical points;
/// - `noisy`: all points; every one of another value than its neighbours, so that more than half are critical;
/// - `ball`: the points in the largest ball, waves;
/// - `shells`: the points in three thin shells about the middle, waves with noise: a third of them on the surface;
/// - `dense`: all points, moved towards a corner: most of them near it.
GALE_EXPORT bool is_synthetic(const std::string& kind);

/// Makes a mesh of a kind (`is_synthetic`), with n^3 points or those of them that it keeps. Throws `Error` if there is
/// no such kind, and as make_grid does.
GALE_EXPORT Dataset make_synthetic(const std::string& kind, int n, GridCells cells = GridCells::written);

/// The vertices of some layers along z of make_grid's mesh, or along y of make_plane's, whichever of both has so many
/// points along x, y and z: their field and, if they are wanted, their points. No cells. Throws `Error` for no such
/// mesh, and where the whole has more than 2^32 vertices (n > 1625, 65535).
GALE_EXPORT Dataset make_layers(const std::array<Id, 3>& of, const Interval& layers, bool has_points);

/// A slab of the mesh of make_grid: some layers of cubes, and the vertices at these.
template <class Index>
struct GridPartOf {
  Dataset::Points<float> points;  ///< where they are in the whole mesh
  std::vector<float> field;       ///< a value for each point
  std::int64_t first_vertex = 0;  ///< the others are numbered on from it, as in the whole mesh

  /// The four vertices of each tetrahedron, by their numbers in the whole mesh.
  Kokkos::View<Index* [4], Kokkos::LayoutRight, Kokkos::HostSpace> tetrahedra;
  std::int64_t first_tetrahedron = 0;  ///< the others are numbered on from it, as in the whole mesh
};

/// A slab whose tetrahedra name vertices by 64 bits.
using GridPart = GridPartOf<std::int64_t>;

/// The `part`-th of `parts` slabs of grid:n, of about as many layers; empty ones where there are more parts than
/// layers. Neighbouring slabs have the vertices between them in common. Throws `Error` if n < 2, if the whole mesh has
/// more than 2^32 vertices (n > 1625), or if the slab's vertices or tetrahedra don't fit 32-bit ids. `Index` is
/// std::int64_t or, where the whole mesh's vertices fit it (n < 1291), std::int32_t, in half the memory.
template <class Index = std::int64_t>
GALE_EXPORT GridPartOf<Index> make_grid_part(int n, int part, int parts);

}  // namespace gale::io
