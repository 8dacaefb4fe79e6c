#pragma once

#include <array>
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
  std::vector<std::string> notices;  ///< as in `Dataset`
};

/// Makes the array called `name` the image's first; an empty name means the one that is first already. `NAME_K` picks
/// component K of an array NAME with several and adds it as an array of one. Throws `Error` if there is no such array,
/// or if it has several components.
GALE_EXPORT void select_scalars(Image& image, const std::string& name);

/// Replaces every value v by slope*v + intercept, in double for 32- and 64-bit integers and doubles, else in float.
/// Does nothing where that would change nothing, or for a slope of 0, which stands for "none" in NIfTI.
GALE_EXPORT void rescale(Image& image, double slope, double intercept);

/// Reverses the order of the slices (k) and the transformation with it: every voxel stays where it is in space.
GALE_EXPORT void reverse_slices(Image& image);

}  // namespace gale::io
