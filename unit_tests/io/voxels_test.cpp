#include <cmath>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

#include <gale/io/image.hpp>
#include <gale/io/synthetic.hpp>

#include "io/io_fixtures.hpp"

namespace gale::io {
namespace {

using test::error_of;
using test::points_of;
using test::tetrahedra_of;
using test::values_of;

/// An image whose value at every voxel is 1 + its place, x fastest.
Image counting_image(int nx, int ny, int nz) {
  std::vector<float> values(nx * ny * nz);
  std::iota(values.begin(), values.end(), 1.f);
  Image image;
  image.dimensions = {nx, ny, nz};
  image.arrays = {{"value", 1, values}};
  return image;
}

std::vector<float>& value_of(Image& image) { return std::get<std::vector<float>>(image.arrays[0].values); }

TEST(SplitVoxels, AllVoxelsMakeTheGrid) {
  for (const int n : {2, 3, 5}) {
    const Dataset mesh = split_voxels(counting_image(n, n, n), 0), grid = make_grid(n);
    EXPECT_EQ(points_of(mesh), points_of(grid));
    EXPECT_EQ(tetrahedra_of(mesh), tetrahedra_of(grid));
    EXPECT_EQ(mesh.points.index(), 0u);
  }
}

TEST(SplitVoxels, DimensionsMayDiffer) {
  const Dataset mesh = split_voxels(counting_image(4, 2, 3), 0);
  EXPECT_EQ(test::point_count_of(mesh), 24u);
  EXPECT_EQ(mesh.tetrahedra.extent(0), 6u * 3 * 1 * 2);
  // The last cube's first tetrahedron: from the voxel (2, 0, 1) along x, y, z.
  const std::size_t t = 6 * 5;
  EXPECT_EQ(mesh.tetrahedra(t, 0), 1 * 8 + 2);
  EXPECT_EQ(mesh.tetrahedra(t, 1), 1 * 8 + 3);
  EXPECT_EQ(mesh.tetrahedra(t, 2), 1 * 8 + 4 + 3);
  EXPECT_EQ(mesh.tetrahedra(t, 3), 2 * 8 + 4 + 3);
}

TEST(SplitVoxels, AMissingCornerTakesItsCubeAlone) {
  Image image = counting_image(3, 3, 3);
  value_of(image)[0] = 0;
  const Dataset mesh = split_voxels(image, 0);
  ASSERT_EQ(test::point_count_of(mesh), 26u);
  EXPECT_EQ(mesh.tetrahedra.extent(0), 7u * 6);
  // Vertex i is the voxel i+1, whose value is i+2; the first cube left has its lowest corner at (1, 0, 0).
  for (int i = 0; i < 26; ++i) EXPECT_EQ(values_of<float>(mesh.arrays[0])[i], i + 2.f);
  EXPECT_EQ(points_of(mesh)[0], 1);
  EXPECT_EQ(
      (std::vector<int>{mesh.tetrahedra(0, 0), mesh.tetrahedra(0, 1), mesh.tetrahedra(0, 2), mesh.tetrahedra(0, 3)}),
      (std::vector<int>{0, 1, 4, 13}));
}

TEST(SplitVoxels, TheMiddleVoxelIsEveryCubes) {
  Image image = counting_image(3, 3, 3);
  value_of(image)[13] = 0;
  EXPECT_EQ(error_of([&] { split_voxels(image, 0); }), "no eight neighbouring voxels of 'value' are all above 0");
}

TEST(SplitVoxels, VoxelsOutsideAllCubesAreLeftOut) {
  Image image = counting_image(4, 2, 2);
  value_of(image)[2] = 0;  // (2, 0, 0): of three cubes in a row two go, and with them the whole plane x = 3
  const Dataset mesh = split_voxels(image, 0.5);
  EXPECT_EQ(mesh.tetrahedra.extent(0), 6u);
  EXPECT_EQ(values_of<float>(mesh.arrays[0]), (std::vector<float>{1, 2, 5, 6, 9, 10, 13, 14}));
}

TEST(SplitVoxels, AboveMeansGreater) {
  Image image = counting_image(3, 2, 2);
  for (float& value : value_of(image)) value = 4;
  value_of(image)[2] = 3;  // (2, 0, 0), a corner of the second cube
  EXPECT_EQ(split_voxels(image, 2.9).tetrahedra.extent(0), 12u);
  EXPECT_EQ(split_voxels(image, 3).tetrahedra.extent(0), 6u);
}

TEST(SplitVoxels, WholeNumbersOf64BitsAreComparedExactly) {
  constexpr std::int64_t most = std::int64_t(1) << 53;
  const auto has_any = [](PointArray::Values values, double above) {
    Image image = counting_image(2, 2, 2);
    image.arrays = {{"value", 1, std::move(values)}};
    return error_of([&] { split_voxels(image, above); }) == "no error";
  };
  EXPECT_TRUE(has_any(std::vector<std::int64_t>(8, most + 1), 9007199254740992.));
  EXPECT_FALSE(has_any(std::vector<std::int64_t>(8, most), 9007199254740992.));
  EXPECT_TRUE(has_any(std::vector<std::int64_t>(8, -most + 1), -9007199254740992.));
  EXPECT_TRUE(has_any(std::vector<std::uint64_t>(8, 0), -0.5));
  EXPECT_TRUE(has_any(std::vector<std::uint64_t>(8, ~std::uint64_t(0)), 18446744073709549568.));
  EXPECT_FALSE(has_any(std::vector<std::uint64_t>(8, ~std::uint64_t(0)), 18446744073709551616.));
  EXPECT_FALSE(has_any(std::vector<std::int64_t>(8, std::numeric_limits<std::int64_t>::max()), 1e300));
}

TEST(SplitVoxels, NanIsNeverAbove) {
  Image image = counting_image(3, 2, 2);
  value_of(image)[0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(split_voxels(image, std::nullopt).tetrahedra.extent(0), 6u);
  EXPECT_EQ(split_voxels(image, -1e300).tetrahedra.extent(0), 6u);
}

TEST(SplitVoxels, InfinityIsAboveButNotFinite) {
  Image image = counting_image(3, 2, 2);
  value_of(image)[0] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(split_voxels(image, std::nullopt).tetrahedra.extent(0), 6u);
  EXPECT_EQ(split_voxels(image, 0).tetrahedra.extent(0), 12u);
}

TEST(SplitVoxels, IntegersAreFinite) {
  Image image = counting_image(2, 2, 2);
  image.arrays = {{"value", 1, std::vector<std::int8_t>(8, -128)}};
  EXPECT_EQ(split_voxels(image, std::nullopt).tetrahedra.extent(0), 6u);
  EXPECT_EQ(error_of([&] { split_voxels(image, -128); }), "no eight neighbouring voxels of 'value' are all above -128");
}

TEST(SplitVoxels, PointsFollowTheTransformation) {
  Image image = counting_image(2, 2, 2);
  image.index_to_physical = {{{0, 2, 0, 10}, {3, 0, 1, 20}, {0, 0, -1, 30}}};
  const std::vector<double> points = points_of(split_voxels(image, 0));
  // The voxel (1, 1, 1): 2 + 10, 3 + 1 + 20, -1 + 30.
  EXPECT_EQ(std::vector<double>(points.end() - 3, points.end()), (std::vector<double>{12, 24, 29}));
  EXPECT_EQ(std::vector<double>(points.begin(), points.begin() + 3), (std::vector<double>{10, 20, 30}));
}

TEST(SplitVoxels, PointsAreDoubleWhereFloatWouldMoveThem) {
  Image image = counting_image(2, 2, 2);
  image.index_to_physical = {{{0.1, 0, 0, 5e5}, {0, 0.1, 0, 0}, {0, 0, 0.1, 0}}};
  const Dataset mesh = split_voxels(image, 0);
  ASSERT_EQ(mesh.points.index(), 1u);
  EXPECT_EQ(points_of(mesh)[3], 5e5 + 0.1);
}

TEST(SplitVoxels, ArraysOfEveryTypeTravel) {
  Image image = counting_image(2, 2, 2);
  const std::vector<PointArray> arrays = test::arrays_of_every_type(8);
  image.arrays.insert(image.arrays.end(), arrays.begin(), arrays.end());
  image.notices = {"a notice"};
  const Dataset mesh = split_voxels(image, 0);
  test::expect_same(mesh.arrays, image.arrays);
  EXPECT_EQ(mesh.notices, image.notices);
}

TEST(SplitVoxels, RefusesRowsOfVoxelsAndEmptyResults) {
  EXPECT_EQ(error_of([] { split_voxels(counting_image(4, 1, 1), 0); }),
            "the image has 4 x 1 x 1 voxels: it needs at least 2 in two directions");
  EXPECT_EQ(error_of([] { split_voxels(counting_image(2, 2, 2), 8.5); }),
            "no eight neighbouring voxels of 'value' are all above 8.5");
  Image image = counting_image(2, 2, 2);
  value_of(image)[3] = std::nanf("");
  EXPECT_EQ(error_of([&] { split_voxels(image, std::nullopt); }),
            "no eight neighbouring voxels of 'value' are all finite");
  image.arrays.front().values = std::vector<float>(7);
  EXPECT_EQ(error_of([&] { split_voxels(image, 0); }), "the array 'value' has 7 rows for 8 voxels");
}

}  // namespace
}  // namespace gale::io
