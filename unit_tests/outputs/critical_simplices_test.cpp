#include "outputs/outputs_of.hpp"

namespace gale::test {

// Two tetrahedra with a minimum at either tip, 0 and 4. Vertex 1 falls to 0, so its edge to 4 is the 1-saddle between
// them: the fifth, counted from 0, of the edges 01 02 03 12 13 14 23 24 34.
TEST(CriticalSimplexSet, has_minima_at_vertices_and_1_saddles_in_the_middle_of_edges) {
  const OutputsOf of = outputs_of(two_tetrahedra(), {0, 2, 3, 4, 1});
  const io::PointSet set = outputs::to_point_set(of.dataset, of.critical);
  expect_points(set.points, {{0, 0, 1}, {0, 0, -1}, {0.5, 0, -0.5}});
  EXPECT_EQ(names_of(set.arrays), (std::vector<std::string>{"field", "place", "CellDimension", "CellId", "IsOnBoundary",
                                                            "ttkVertexScalarField"}));
  EXPECT_EQ(values_of<double>(set.arrays, "field"), (std::vector<double>{0, 1, 2})) << "at the highest vertex of each";
  EXPECT_EQ(values_of<std::int32_t>(set.arrays, "place"), (std::vector<std::int32_t>{0, 4, 1}));
  EXPECT_EQ(values_of<std::int8_t>(set.arrays, "CellDimension"), (std::vector<std::int8_t>{0, 0, 1}));
  EXPECT_EQ(values_of<Id>(set.arrays, "CellId"), (std::vector<Id>{0, 4, 5}));
  EXPECT_EQ(values_of<std::int8_t>(set.arrays, "IsOnBoundary"), (std::vector<std::int8_t>{1, 1, 1}));
  EXPECT_EQ(values_of<Id>(set.arrays, "ttkVertexScalarField"), (std::vector<Id>{0, 4, 1}));
}

// The octahedron's surface has its minimum at vertex 2 and its maximum at 1, whose highest triangle 156 is the
// 2-saddle: it follows the twelve triangles at 0 and 134, 136, 145. The centre is the maximum, with its highest
// tetrahedron, 0156, which is the fourth.
TEST(CriticalSimplexSet, has_2_saddles_at_incentres_and_maxima_at_barycentres) {
  const OutputsOf of = outputs_of(octahedron(), {10, 5, -5, 1, 2, 3, 4});
  const io::PointSet set = outputs::to_point_set(of.dataset, of.critical);
  const double third = 1.0 / 3;
  expect_points(set.points, {{0, 0, -1}, {-third, -third, third}, {-0.25, -0.25, 0.25}});
  EXPECT_EQ(values_of<std::int8_t>(set.arrays, "CellDimension"), (std::vector<std::int8_t>{0, 2, 3}));
  EXPECT_EQ(values_of<Id>(set.arrays, "CellId"), (std::vector<Id>{2, 15, 4}));
  EXPECT_EQ(values_of<std::int8_t>(set.arrays, "IsOnBoundary"), (std::vector<std::int8_t>{1, 1, 0}));
  EXPECT_EQ(values_of<Id>(set.arrays, "ttkVertexScalarField"), (std::vector<Id>{2, 1, 0}));
}

TEST(KnownSimplices, have_their_vertices_from_the_highest_to_the_lowest) {
  const OutputsOf of = outputs_of(octahedron(), {10, 5, -5, 1, 2, 3, 4});
  const outputs::CriticalSimplex &triangle = of.critical[2].front(), &tetrahedron = of.critical[3].front();
  EXPECT_EQ((std::vector<Id>{triangle.vertices.begin(), triangle.vertices.begin() + 3}), (std::vector<Id>{1, 6, 5}));
  EXPECT_EQ(tetrahedron.vertices, (std::array<Id, 4>{0, 1, 6, 5}));
  EXPECT_EQ(triangle.highest(), 1);
  EXPECT_EQ(triangle.lowest(), 5);
  EXPECT_EQ(tetrahedron.highest(), 0);
  EXPECT_EQ(tetrahedron.lowest(), 5);
}

}  // namespace gale::test
