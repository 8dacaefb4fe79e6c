#include <limits>

#include <gale/outputs/separatrices1.hpp>

#include "outputs/outputs_of.hpp"

namespace gale::test {

namespace {

io::Surface lines_of(const OutputsOf& of) {
  return outputs::separatrices1(of.dataset, of.field, of.complex, of.named, of.numbers, of.critical);
}

using Bytes = std::vector<std::int8_t>;
using Ids = std::vector<Id>;
using Values = std::vector<double>;

}  // namespace

// The 1-saddle is edge 14, number 5. From its vertex 1 the path falls over edge 01, number 0, to vertex 0; its vertex 4
// is a minimum itself.
TEST(Separatrices1, fall_from_a_1_saddle_to_minima) {
  const io::Surface lines = lines_of(outputs_of(two_tetrahedra(), {0, 2, 3, 4, 1}));
  expect_points(lines.points, {{0.5, 0, -0.5}, {0.5, 0, 0.5}, {1, 0, 0}, {0, 0, 1}, {0, 0, -1}});
  EXPECT_EQ(names_of(lines.point_arrays), (std::vector<std::string>{"ttkMaskScalarField", "CellDimension", "CellId"}));
  EXPECT_EQ(values_of<std::int8_t>(lines.point_arrays, "ttkMaskScalarField"), (Bytes{0, 1, 1, 0, 0}));
  EXPECT_EQ(values_of<std::int8_t>(lines.point_arrays, "CellDimension"), (Bytes{1, 1, 0, 0, 0}));
  EXPECT_EQ(values_of<Id>(lines.point_arrays, "CellId"), (Ids{5, 0, 1, 0, 4}));
  EXPECT_EQ(lines.lines.begin, (std::vector<std::int64_t>{0, 4, 6}));
  EXPECT_EQ(lines.lines.points, (Ids{0, 2, 1, 3, 0, 4}));
  EXPECT_EQ(lines.polygons.points.size(), 0u);
  EXPECT_EQ(names_of(lines.cell_arrays),
            (std::vector<std::string>{"SourceId", "DestinationId", "SeparatrixId", "SeparatrixType",
                                      "SeparatrixFunctionMaximum", "SeparatrixFunctionMinimum",
                                      "SeparatrixFunctionDifference", "NumberOfCriticalPointsOnBoundary"}));
  EXPECT_EQ(values_of<Id>(lines.cell_arrays, "SourceId"), (Ids{5, 5}));
  EXPECT_EQ(values_of<Id>(lines.cell_arrays, "DestinationId"), (Ids{0, 4}));
  EXPECT_EQ(values_of<Id>(lines.cell_arrays, "SeparatrixId"), (Ids{0, 1}));
  EXPECT_EQ(values_of<std::int8_t>(lines.cell_arrays, "SeparatrixType"), (Bytes{0, 0}));
  EXPECT_EQ(values_of<double>(lines.cell_arrays, "SeparatrixFunctionMaximum"), (Values{2, 2}));
  EXPECT_EQ(values_of<double>(lines.cell_arrays, "SeparatrixFunctionMinimum"), (Values{0, 1}));
  EXPECT_EQ(values_of<double>(lines.cell_arrays, "SeparatrixFunctionDifference"), (Values{2, 1}));
  EXPECT_EQ(values_of<Id>(lines.cell_arrays, "NumberOfCriticalPointsOnBoundary"), (std::vector<Id>{2, 2}));
}

// The 2-saddle, triangle 156, number 15, is a face of the maximum, tetrahedron 4: that is the way. It has no other.
TEST(Separatrices1, rise_from_a_2_saddle_to_a_maximum) {
  const io::Surface lines = lines_of(outputs_of(octahedron(), {10, 5, -5, 1, 2, 3, 4}));
  const double third = 1.0 / 3;
  expect_points(lines.points, {{-third, -third, third}, {-0.25, -0.25, 0.25}});
  EXPECT_EQ(values_of<std::int8_t>(lines.point_arrays, "ttkMaskScalarField"), (Bytes{0, 0}));
  EXPECT_EQ(values_of<std::int8_t>(lines.point_arrays, "CellDimension"), (Bytes{2, 3}));
  EXPECT_EQ(values_of<Id>(lines.point_arrays, "CellId"), (Ids{15, 4}));
  EXPECT_EQ(values_of<Id>(lines.cell_arrays, "SourceId"), (Ids{15}));
  EXPECT_EQ(values_of<Id>(lines.cell_arrays, "DestinationId"), (Ids{4}));
  EXPECT_EQ(values_of<std::int8_t>(lines.cell_arrays, "SeparatrixType"), (Bytes{2}));
  EXPECT_EQ(values_of<double>(lines.cell_arrays, "SeparatrixFunctionMaximum"), (Values{10})) << "at vertex 0";
  EXPECT_EQ(values_of<double>(lines.cell_arrays, "SeparatrixFunctionMinimum"), (Values{3})) << "at vertex 5";
  EXPECT_EQ(values_of<double>(lines.cell_arrays, "SeparatrixFunctionDifference"), (Values{7}));
  EXPECT_EQ(values_of<Id>(lines.cell_arrays, "NumberOfCriticalPointsOnBoundary"), (std::vector<Id>{1}));
}

TEST(Separatrices1, between_equal_infinities_differ_by_nothing) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const io::Surface lines = lines_of(outputs_of(two_tetrahedra(), std::vector<double>(5, infinity)));
  for (const double difference : values_of<double>(lines.cell_arrays, "SeparatrixFunctionDifference"))
    EXPECT_EQ(difference, 0);
  const io::Surface two = lines_of(outputs_of(two_tetrahedra(), {-infinity, infinity, infinity, infinity, -infinity}));
  EXPECT_EQ(values_of<double>(two.cell_arrays, "SeparatrixFunctionDifference"), Values(2, infinity));
}

TEST(Separatrices1, may_be_none_and_have_all_arrays) {
  const io::Surface lines = lines_of(outputs_of(unit_tetrahedron(), {0, 1, 2, 3}));
  expect_points(lines.points, {});
  EXPECT_EQ(lines.lines.begin, (std::vector<std::int64_t>{0}));
  EXPECT_EQ(lines.point_arrays.size(), 3u);
  EXPECT_EQ(lines.cell_arrays.size(), 8u);
}

}  // namespace gale::test
