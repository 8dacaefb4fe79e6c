#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <gale/export.hpp>
#include <gale/io/dataset.hpp>

namespace gale::io {

/// A regular image: dimensions[0] * dimensions[1] * dimensions[2] voxels, x fastest, each with a value of every array.
struct Image {
  std::array<int, 3> dimensions{};  ///< voxels along x, y and z

  /// Row d gives coordinate d of the voxel (i, j, k): row[0]*i + row[1]*j + row[2]*k + row[3].
  std::array<std::array<double, 4>, 3> index_to_physical{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  std::vector<PointArray> arrays;    ///< the scalars first
  std::vector<std::string> notices;  ///< what `Dataset` has as such
};

/// Makes the array called `name` the image's first; an empty name means the one that is first already. `NAME_K` picks
/// component K of an array NAME with several and adds it as an array of one. Throws `Error` if there is no such array,
/// or if it has several components.
GALE_EXPORT void select_scalars(Image& image, const std::string& name);

/// Replaces every value v by slope*v + intercept, in double for 32- and 64-bit integers and doubles, else in float.
/// Does nothing where that would change nothing, or for a slope of 0, which stands for "none" in NIfTI.
GALE_EXPORT void rescale(Image& image, double slope, double intercept);

/// The tetrahedral mesh of the voxels whose value in the image's first array is above `above`; without it, of those
/// whose value is finite. NaN is never above. A cube of eight such neighbouring voxels becomes six tetrahedra along its
/// main diagonal (Freudenthal), so neighbours share faces. An image of one layer, along any axis, is a mesh of
/// triangles: a square of four such neighbours becomes two along its diagonal, as in `make_plane`.
///
/// Vertices are the voxels that some cube uses, x fastest; tetrahedra follow their cubes, x fastest, and within a cube
/// `make_grid`'s order. (Every edge joins voxels that are ordered alike along all three axes, so where values tie
/// it makes no difference to critical points which axis is numbered fastest.) Points are float unless that would move
/// them by more than a hundredth of a voxel; all arrays travel, in their types.
///
/// `cells` says whether these are written out, or the dataset has a grid, with points or without.
///
/// Runs on all host threads; besides image and result it takes three bits a voxel. Throws `Error` if two
/// dimensions are below 2, if no cube is left, or if the vertices or tetrahedra do not fit 32-bit ids. Precondition:
/// `select_scalars`.
GALE_EXPORT Dataset split_voxels(Image image, std::optional<double> above, GridCells cells = GridCells::written);

namespace detail {

/// Throws gale::Error if there are more of something than ids can number: "THESE 3000000000 VERTICES, more than ...".
GALE_EXPORT void require_ids_for(const std::string& these, double count, const std::string& of_what);

}  // namespace detail
}  // namespace gale::io
