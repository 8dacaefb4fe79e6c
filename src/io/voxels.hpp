#pragma once

#include <optional>

#include <gale/export.hpp>
#include <gale/io/dataset.hpp>
#include <gale/io/image.hpp>

namespace gale::io {

/// The tetrahedral mesh of the voxels whose value in the image's first array is above `above`; without it, of those
/// whose value is finite. NaN is never above. A cube of eight such neighbouring voxels becomes six tetrahedra along its
/// main diagonal (Freudenthal), so neighbours share faces.
///
/// Vertices are the voxels that some cube uses, x fastest; tetrahedra follow their cubes, x fastest, and within a cube
/// `make_grid`'s order. (Every edge joins voxels that are ordered alike along all three axes, so where values tie
/// it makes no difference to critical points which axis is numbered fastest.) Points are float unless that would move
/// them by more than a hundredth of a voxel; all arrays travel, in their types.
///
/// Runs on all host threads; besides image and result it takes two bytes a voxel. Throws `Error` if a dimension is
/// below 2, if no cube is left, or if the vertices or tetrahedra do not fit 32-bit ids. Precondition: `select_scalars`.
GALE_EXPORT Dataset split_voxels(Image image, std::optional<double> above);

}  // namespace gale::io
