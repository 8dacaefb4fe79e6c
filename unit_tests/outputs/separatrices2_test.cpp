#include <set>

#include <gale/outputs/separatrices2.hpp>

#include "outputs/outputs_of.hpp"

namespace gale::test {

namespace {

io::Surface walls_of(const OutputsOf& of) {
  return outputs::separatrices2(of.dataset, of.field, of.complex, of.complex.connectors, of.critical);
}

std::vector<Id> polygon(const io::Surface& walls, std::size_t i) {
  const auto& all = walls.polygons;
  return {all.points.begin() + all.begin[i], all.points.begin() + all.begin[i + 1]};
}

}  // namespace

// The surface of the octahedron has one minimum and one maximum, so the 2-saddle's falling paths sweep all of it.
TEST(Separatrices2, the_descending_wall_of_a_maximum_on_the_surface_is_the_surface) {
  const InputMesh mesh = octahedron();
  const OutputsOf of = outputs_of(mesh, {10, 5, -5, 1, 2, 3, 4});
  const io::Surface walls = walls_of(of);
  expect_points(walls.points, {mesh.points.begin() + 1, mesh.points.end()});
  ASSERT_EQ(walls.polygons.begin.size(), 9u);
  std::set<std::set<Id>> triangles, expected;
  for (std::size_t i = 0; i < 8; ++i) {
    const auto points = polygon(walls, i);
    EXPECT_EQ(points.size(), 3u);
    std::set<Id> triangle;
    for (const Id point : points) triangle.insert(point + 1);
    triangles.insert(triangle);
  }
  for (const auto& tetrahedron : mesh.tetrahedra) {
    std::set<Id> triangle(tetrahedron.begin(), tetrahedron.end());
    triangle.erase(0);
    expected.insert(triangle);
  }
  EXPECT_EQ(triangles, expected);
  EXPECT_EQ(names_of(walls.cell_arrays),
            (std::vector<std::string>{"SourceId", "SeparatrixId", "SeparatrixType", "SeparatrixFunctionMaximum",
                                      "SeparatrixFunctionMinimum", "SeparatrixFunctionDifference",
                                      "NumberOfCriticalPointsOnBoundary"}));
  EXPECT_EQ(values_of<Id>(walls.cell_arrays, "SourceId"), std::vector<Id>(8, 15));
  EXPECT_EQ(values_of<Id>(walls.cell_arrays, "SeparatrixId"), std::vector<Id>(8, 0));
  EXPECT_EQ(values_of<std::int8_t>(walls.cell_arrays, "SeparatrixType"), std::vector<std::int8_t>(8, 2));
  EXPECT_EQ(values_of<double>(walls.cell_arrays, "SeparatrixFunctionMaximum"), std::vector<double>(8, 5));
  EXPECT_EQ(values_of<double>(walls.cell_arrays, "SeparatrixFunctionMinimum"), std::vector<double>(8, -5));
  EXPECT_EQ(values_of<double>(walls.cell_arrays, "SeparatrixFunctionDifference"), std::vector<double>(8, 10));
  EXPECT_EQ(values_of<Id>(walls.cell_arrays, "NumberOfCriticalPointsOnBoundary"), std::vector<Id>(8, 1));
}

// Both caps are minima, and edge 01 is the 1-saddle between them. It has the tetrahedra 0, 2, 4 and 6 around it.
TEST(Separatrices2, an_ascending_wall_has_a_polygon_through_the_tetrahedra_around_an_edge) {
  const OutputsOf of = outputs_of(octahedron(), {0, -1, -2, 1, 2, 3, 4});
  ASSERT_EQ(of.complex.critical.counts(), (std::array<Id, 4>{2, 1, 0, 0}));
  const io::Surface walls = walls_of(of);
  expect_points(walls.points, {{0.25, 0.25, 0.25}, {-0.25, 0.25, 0.25}, {-0.25, -0.25, 0.25}, {0.25, -0.25, 0.25}});
  ASSERT_EQ(walls.polygons.begin, (std::vector<std::int64_t>{0, 4})) << "edges of the surface have two tetrahedra each";
  const auto around = polygon(walls, 0);
  EXPECT_EQ((std::set<Id>(around.begin(), around.end())), (std::set<Id>{0, 1, 2, 3}));
  for (int i = 0; i < 4; ++i) EXPECT_EQ((around[i] + around[(i + 1) % 4]) % 2, 1) << "neighbours share a triangle";
  EXPECT_EQ(values_of<Id>(walls.cell_arrays, "SourceId"), (std::vector<Id>{0}));
  EXPECT_EQ(values_of<std::int8_t>(walls.cell_arrays, "SeparatrixType"), (std::vector<std::int8_t>{1}));
  EXPECT_EQ(values_of<double>(walls.cell_arrays, "SeparatrixFunctionMaximum"), (std::vector<double>{4})) << "vertex 6";
  EXPECT_EQ(values_of<double>(walls.cell_arrays, "SeparatrixFunctionMinimum"), (std::vector<double>{-1}));
  EXPECT_EQ(values_of<Id>(walls.cell_arrays, "NumberOfCriticalPointsOnBoundary"), (std::vector<Id>{0}));
}

TEST(Separatrices2, may_be_none_and_have_all_arrays) {
  const io::Surface walls = walls_of(outputs_of(unit_tetrahedron(), {0, 1, 2, 3}));
  expect_points(walls.points, {});
  EXPECT_EQ(walls.polygons.begin, (std::vector<std::int64_t>{0}));
  EXPECT_EQ(walls.cell_arrays.size(), 7u);
}

}  // namespace gale::test
