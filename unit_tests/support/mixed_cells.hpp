#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <vector>

namespace gale::test {

/// A cell of any type as VTK numbers and orders it, and its faces, which tests know by themselves.
struct MixedCell {
  int type;
  std::vector<std::int64_t> points;  ///< of a polyhedron its faces, as gale::Cells has them
  std::vector<std::vector<std::int64_t>> faces;
};

/// Cells of several types that fit, in any order.
struct MixedMesh {
  std::vector<std::array<double, 3>> points;
  std::vector<MixedCell> cells;
  double volume = 0;

  std::vector<std::int64_t> connectivity() const;
  std::vector<std::int64_t> offsets() const;
  std::vector<std::uint8_t> types() const;

  /// Has the points in another order, at random; cells name them by their new numbers.
  void renumber(std::mt19937& random);
};

/// Hexahedra, voxels, wedges, pyramids, prisms and polyhedra that fill a box of `side`^2 columns of `height` cells,
/// with plane faces, all ids and the order of cells shuffled.
MixedMesh mixed_mesh(int side, int height, std::uint32_t seed);

/// A cylinder of hexahedra around an axis, where each names two points twice.
MixedMesh collapsed_cylinder(int around, int layers, int height, std::uint32_t seed);

}  // namespace gale::test
