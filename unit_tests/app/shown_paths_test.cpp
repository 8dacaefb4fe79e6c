#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include <gale/app/drawing/picture.hpp>

namespace gale::app {

namespace {

/// A path of a surface of lines: `mask` is that of its last point.
struct GivenPath {
  std::vector<Point> points;
  std::vector<Id> ids;  ///< of the cells there, by turns of dimension 1 and 0
  std::int8_t mask;
  float difference;
};

/// A surface of descending separatrices to the same minimum, which have points of the same cell in common.
io::Surface surface_of(const std::vector<GivenPath>& paths) {
  io::Surface surface;
  std::vector<Point> points;
  std::vector<std::int8_t> mask, dimensions, types;
  std::vector<Id> ids, destinations;
  std::vector<float> differences;
  std::map<std::pair<int, Id>, std::int32_t> known;
  for (const GivenPath& path : paths) {
    for (std::size_t k = 0; k < path.points.size(); ++k) {
      const auto dimension = static_cast<std::int8_t>(1 - k % 2);
      const auto [at, is_new] = known.insert({{dimension, path.ids[k]}, static_cast<std::int32_t>(points.size())});
      surface.lines.points.push_back(at->second);
      if (!is_new) continue;
      points.push_back(path.points[k]);
      dimensions.push_back(dimension);
      ids.push_back(path.ids[k]);
      mask.push_back(k == 0 ? 0 : k + 1 < path.points.size() ? 1 : path.mask);
    }
    surface.lines.begin.push_back(static_cast<std::int64_t>(surface.lines.points.size()));
    types.push_back(0);
    destinations.push_back(7);
    differences.push_back(path.difference);
  }
  io::Dataset::Points<double> positions("points", points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) positions(i, axis) = points[i][axis];
  }
  surface.points = positions;
  surface.point_arrays = {{"ttkMaskScalarField", 1, mask}, {"CellDimension", 1, dimensions}, {"CellId", 1, ids}};
  surface.cell_arrays = {{"SeparatrixType", 1, types},
                         {"DestinationId", 1, destinations},
                         {"SeparatrixFunctionDifference", 1, differences}};
  return surface;
}

/// One along the x axis to (3, 0, 0); one that joins it at (1, 0, 0), and is told as far as that; one beside both.
io::Surface three_paths() {
  return surface_of({{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {10, 11, 12, 7}, 0, 2},
                     {{{1, 2, 0}, {1, 0, 0}}, {20, 11}, 1, 3},
                     {{{0, 9, 0}, {1, 9, 0}}, {30, 31}, 0, 1}});
}

std::vector<std::size_t> sizes_of(const std::vector<std::vector<Point>>& stretches) {
  std::vector<std::size_t> sizes;
  for (const auto& stretch : stretches) sizes.push_back(stretch.size());
  return sizes;
}

bool everywhere(const Point&) { return true; }

}  // namespace

// The second path, along which the field changes most, comes first, and goes on along the first; of that, one line is
// left. Nothing leads from one path's end to the next one's beginning.
TEST(ShownPaths, are_apart_and_none_is_shown_twice) {
  const ShownPaths shown = shown_paths(three_paths(), 9, everywhere);
  EXPECT_EQ(sizes_of(shown.kinds[0].stretches), (std::vector<std::size_t>{4, 2, 2}));
  EXPECT_TRUE(shown.are_all());
  for (const auto& stretch : shown.kinds[0].stretches) {
    for (std::size_t k = 1; k < stretch.size(); ++k) {
      EXPECT_LE(std::hypot(stretch[k][0] - stretch[k - 1][0], stretch[k][1] - stretch[k - 1][1]), 2);
    }
  }
}

TEST(ShownPaths, go_on_as_the_path_does_that_they_join) {
  const ShownPaths shown = shown_paths(three_paths(), 1, everywhere);
  ASSERT_EQ(sizes_of(shown.kinds[0].stretches), (std::vector<std::size_t>{4}));
  EXPECT_EQ(shown.kinds[0].stretches[0].front(), (Point{1, 2, 0}));
  EXPECT_EQ(shown.kinds[0].stretches[0].back(), (Point{3, 0, 0}));
  EXPECT_EQ(shown.ends, (std::set<std::pair<int, Id>>{{1, 20}, {0, 7}}));
  EXPECT_EQ(shown.kinds[0].inside, 3);
  EXPECT_FALSE(shown.are_all());
}

TEST(ShownPaths, end_where_the_inside_does) {
  const ShownPaths shown = shown_paths(three_paths(), 9, [](const Point& point) { return point[0] >= 2; });
  ASSERT_EQ(sizes_of(shown.kinds[0].stretches), (std::vector<std::size_t>{2}));
  EXPECT_EQ(shown.kinds[0].inside, 2) << "the first two";
}

}  // namespace gale::app
