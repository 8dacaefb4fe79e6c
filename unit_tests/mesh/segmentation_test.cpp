#include <algorithm>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include <gale/base/error.hpp>

#include "support/arrays.hpp"
#include "support/every_mesh.hpp"

namespace gale::test {

namespace {

using Points3 = std::vector<std::array<double, 3>>;

/// The segments as lists of input vertices.
std::vector<std::vector<Id>> segments_of(const Segmentation& segmentation) {
  const auto begin = to_vector(segmentation.vertex_begin);
  const auto input = to_vector(segmentation.vertex_input);
  std::vector<std::vector<Id>> segments;
  for (std::size_t s = 0; s + 1 < begin.size(); ++s) {
    segments.emplace_back(input.begin() + begin[s], input.begin() + begin[s + 1]);
  }
  return segments;
}

Points3 grid_points(int side) {
  Points3 points;
  for (int i = 0; i < side * side * side; ++i) {
    points.push_back({double(i % side), double(i / side % side), double(i / side / side)});
  }
  return points;
}

std::vector<std::vector<Id>> octree(const Points3& points, int capacity) {
  return segments_of(octree_of({points, {}}, capacity));
}

void expect_refused(const Points3& points, int capacity, const std::string& message) {
  try {
    octree_of({points, {}}, capacity);
    ADD_FAILURE() << "accepted, instead of: " << message;
  } catch (const Error& error) {
    EXPECT_EQ(error.what(), message);
  }
}

}  // namespace

class SegmentationOf : public EveryMesh {};

TEST_P(SegmentationOf, every_mesh_is_a_partition_into_segments_that_are_not_empty) {
  const Segmentation segmentation = this->segmentation();
  const auto begin = to_vector(segmentation.vertex_begin);
  ASSERT_EQ(begin.front(), 0);
  ASSERT_EQ(begin.back(), input().vertices());
  ASSERT_EQ(segmentation.vertices(), input().vertices());
  ASSERT_EQ(segmentation.segments(), static_cast<Id>(begin.size()) - 1);
  for (std::size_t s = 0; s + 1 < begin.size(); ++s) EXPECT_LT(begin[s], begin[s + 1]) << "segment " << s;
  const auto order = to_vector(segmentation.vertex_input);
  const std::set<Id> distinct(order.begin(), order.end());
  EXPECT_EQ(static_cast<Id>(distinct.size()), input().vertices());
  EXPECT_EQ(*distinct.begin(), 0);
  EXPECT_EQ(*distinct.rbegin(), input().vertices() - 1);
}

INSTANTIATE_TEST_SUITE_P(Tests, SegmentationOf, every_mesh_and_segmentation(), mesh_and_segmentation);

class OctreeOf : public testing::TestWithParam<std::string> {};

TEST_P(OctreeOf, every_mesh_keeps_to_the_capacity_and_merges_what_fits) {
  for (const int capacity : {1, 2, 7, 100, 1000000, std::numeric_limits<int>::max()}) {
    const auto segments = segments_of(octree_of(mesh_named(GetParam()), capacity));
    for (std::size_t s = 0; s < segments.size(); ++s) {
      EXPECT_LE(segments[s].size(), std::size_t(capacity));
      if (s > 0) {
        EXPECT_GT(segments[s - 1].size() + segments[s].size(), std::size_t(capacity))
            << "segments " << s - 1 << " and " << s << " fit into one";
      }
    }
  }
}

TEST_P(OctreeOf, every_mesh_is_the_same_from_float_and_double) {
  InputMesh mesh = mesh_named(GetParam());
  for (auto& point : mesh.points) {
    for (double& coordinate : point) coordinate = static_cast<float>(coordinate);
  }
  const auto from_float = octree_segmentation(points_of<float>(mesh), 7);
  const auto from_double = octree_segmentation(points_of<double>(mesh), 7);
  EXPECT_EQ(segments_of(from_float), segments_of(from_double));
}

INSTANTIATE_TEST_SUITE_P(Tests, OctreeOf, testing::ValuesIn(mesh_names()), [](const auto& name) { return name.param; });

TEST(Octree, halves_a_grid_into_cubes) {
  const auto points = grid_points(8);
  const auto segments = octree(points, 8);
  ASSERT_EQ(segments.size(), 64u);
  for (const auto& segment : segments) {
    ASSERT_EQ(segment.size(), 8u);
    std::set<std::array<int, 3>> cells;
    for (const Id v : segment) cells.insert({int(points[v][0]) / 2, int(points[v][1]) / 2, int(points[v][2]) / 2});
    EXPECT_EQ(cells.size(), 1u) << "the segment of vertex " << segment[0] << " is not a 2x2x2 cube";
  }
}

TEST(Octree, merges_neighbours_along_the_curve) {
  const auto points = grid_points(8);
  const auto segments = octree(points, 16);  // a leaf has 8: two fit
  ASSERT_EQ(segments.size(), 32u);
  for (const auto& segment : segments) {
    ASSERT_EQ(segment.size(), 16u);
    std::set<std::array<int, 3>> parents;
    for (const Id v : segment) parents.insert({int(points[v][0]) / 4, int(points[v][1]) / 4, int(points[v][2]) / 4});
    EXPECT_EQ(parents.size(), 1u);
  }
}

TEST(Octree, keeps_leaves_whole) {
  // Five points in one octant, four in another: as leaves they are 5 and 4, together more than 8.
  Points3 points(5, {0, 0, 0});
  points.insert(points.end(), 4, {7, 7, 7});
  for (std::size_t i = 0; i < points.size(); ++i) points[i][0] += 0.01 * double(i % 5);
  const auto segments = octree(points, 8);
  ASSERT_EQ(segments.size(), 2u);
  EXPECT_EQ(segments[0].size(), 5u);
  EXPECT_EQ(segments[1].size(), 4u);
}

TEST(Octree, numbers_segments_so_that_neighbours_in_id_are_neighbours_in_space) {
  const auto points = grid_points(8);
  const auto segments = octree(points, 64);
  ASSERT_EQ(segments.size(), 8u);
  for (int s = 0; s < 8; ++s) {
    for (const Id v : segments[s]) {
      // x is the highest bit of a Morton code.
      EXPECT_EQ(s, int(points[v][0]) / 4 * 4 + int(points[v][1]) / 4 * 2 + int(points[v][2]) / 4);
    }
  }
}

TEST(Octree, splits_points_at_one_place) {
  Points3 points(25, {1, 2, 3});
  points.insert(points.begin(), {0, 0, 0});
  points.push_back({9, 9, 9});
  const auto segments = octree(points, 10);
  ASSERT_EQ(segments.size(), 4u);
  EXPECT_EQ(segments[0].size(), 1u);
  EXPECT_EQ(segments[1].size(), 10u);
  EXPECT_EQ(segments[2].size(), 10u);
  EXPECT_EQ(segments[3].size(), 6u) << "the last 5 of the 25, and the point behind them";
}

TEST(Octree, splits_points_closer_than_its_smallest_cells) {
  Points3 points;
  for (int i = 0; i < 20; ++i) points.push_back({1e-9 * i, 0, 0});
  points.push_back({1, 1, 1});
  for (const auto& segment : octree(points, 3)) EXPECT_LE(segment.size(), 3u);
}

TEST(Octree, of_no_points_has_no_segments) {
  EXPECT_TRUE(octree({}, 5).empty());
  EXPECT_EQ(octree_of({}, 5).segments(), 0);
}

TEST(Octree, of_coordinates_of_any_magnitude) {
  constexpr double most = std::numeric_limits<double>::max();
  EXPECT_EQ(octree({{-most, -most, -most}, {most, most, most}}, 1).size(), 2u);
  constexpr double least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(octree({{0, 0, 0}, {least, least, least}}, 1).size(), 2u);
}

TEST(Octree, refuses_a_capacity_below_1) {
  expect_refused({{0, 0, 0}}, 0, "a segment's capacity must be at least 1 vertex, not 0");
  expect_refused({{0, 0, 0}}, -7, "a segment's capacity must be at least 1 vertex, not -7");
}

TEST(Octree, refuses_coordinates_that_are_not_finite_naming_the_first_point) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {infinity, -infinity, std::numeric_limits<double>::quiet_NaN()}) {
    for (int axis = 0; axis < 3; ++axis) {
      auto points = grid_points(20);
      points[5000][axis] = points[4321][axis] = bad;
      expect_refused(points, 100, "point 4321 has a coordinate that is not finite");
    }
  }
}

TEST(GivenSegmentation, has_the_vertices_of_equal_labels_in_input_order_and_ascends) {
  const auto segments = segments_of(segmentation_by({5, INT64_MIN, 5, -1, INT64_MAX, -1, 5}));
  const std::vector<std::vector<Id>> expected = {{1}, {3, 5}, {0, 2, 6}, {4}};
  EXPECT_EQ(segments, expected);
}

TEST(GivenSegmentation, of_no_labels_has_no_segments) { EXPECT_EQ(segmentation_by({}).segments(), 0); }

}  // namespace gale::test
