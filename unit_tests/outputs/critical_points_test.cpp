#include <gtest/gtest.h>

#include <gale/outputs/critical_points.hpp>

#include "outputs/outputs_of.hpp"
#include "support/message_of.hpp"

namespace gale::test {

namespace {

CriticalPoints two_points() {
  CriticalPoints points;
  points.vertices = {1, 3};
  points.types = {CriticalType::saddle2, CriticalType::degenerate};
  points.on_surface = {1, 0};
  return points;
}

}  // namespace

TEST(CriticalPointSet, is_where_the_vertices_are_with_their_arrays) {
  io::Dataset dataset = dataset_of(unit_tetrahedron());
  dataset.arrays = {{"height", 1, std::vector<float>{0, 0.5f, 2, 7}},
                    {"pairs", 2, std::vector<std::int64_t>{0, 1, 2, 3, 4, 5, 6, 7}}};
  const io::PointSet set = outputs::to_point_set(dataset, two_points());
  expect_points(set.points, {{1, 0, 0}, {0, 0, 1}});
  EXPECT_EQ(names_of(set.arrays),
            (std::vector<std::string>{"height", "pairs", "CriticalType", "IsOnBoundary", "ttkVertexScalarField"}));
  EXPECT_EQ(values_of<float>(set.arrays, "height"), (std::vector<float>{0.5f, 7}));
  EXPECT_EQ(set.arrays[1].components, 2);
  EXPECT_EQ(values_of<std::int64_t>(set.arrays, "pairs"), (std::vector<std::int64_t>{2, 3, 6, 7}));
  EXPECT_EQ(values_of<std::int8_t>(set.arrays, "CriticalType"), (std::vector<std::int8_t>{2, 4}));
  EXPECT_EQ(values_of<std::int8_t>(set.arrays, "IsOnBoundary"), (std::vector<std::int8_t>{1, 0}));
  EXPECT_EQ(values_of<Id>(set.arrays, "ttkVertexScalarField"), (std::vector<Id>{1, 3}));
}

TEST(CriticalPointSet, keeps_the_type_of_the_coordinates) {
  io::Dataset dataset;
  dataset.points = io::Dataset::Points<float>("points", 4);
  EXPECT_TRUE(std::holds_alternative<io::Dataset::Points<float>>(outputs::to_point_set(dataset, two_points()).points));
}

TEST(CriticalPointSet, of_none_is_empty) {
  const io::PointSet set = outputs::to_point_set(dataset_of(unit_tetrahedron()), CriticalPoints());
  expect_points(set.points, {});
  EXPECT_EQ(set.arrays.size(), 3u);
}

TEST(CriticalPointSet, needs_a_value_for_each) {
  io::Dataset dataset = dataset_of(unit_tetrahedron());
  dataset.arrays = {{"short", 1, std::vector<float>{0, 1, 2}}};
  EXPECT_EQ(message_of([&] { outputs::to_point_set(dataset, two_points()); }),
            "the array 'short' has 3 rows, no row 3");
}

}  // namespace gale::test
