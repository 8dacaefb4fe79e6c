#include <gtest/gtest.h>

#include <gale/outputs/arrows.hpp>

#include "outputs/outputs_of.hpp"

namespace gale::test {

// The field of the unit tetrahedron rises with the ids: vertex 0 alone is critical. Vertices 1, 2 and 3 are paired with
// their edges to 0, the other edges with their triangles with 0, and triangle 123 with the tetrahedron.
TEST(Arrows, of_a_tetrahedron) {
  const OutputsOf of = outputs_of(unit_tetrahedron(), {0, 1, 2, 3});
  const io::PointSet arrows = outputs::arrows_of(of.dataset, of.complex.gradient);
  const double half = 0.5, third = 1.0 / 3;
  expect_points(arrows.points, {{1, 0, 0},
                                {0, 1, 0},
                                {0, 0, 1},
                                {half, half, 0},  // 2, 1
                                {half, 0, half},  // 3, 1
                                {0, half, half},  // 3, 2
                                {third, third, third}});
  EXPECT_EQ(names_of(arrows.arrays), (std::vector<std::string>{"CellDimension", "Vector"}));
  EXPECT_EQ(values_of<std::int8_t>(arrows.arrays, "CellDimension"), (std::vector<std::int8_t>{0, 0, 0, 1, 1, 1, 2}));
  EXPECT_EQ(arrows.arrays[1].components, 3);
  const auto vector = values_of<double>(arrows.arrays, "Vector");
  const double sixth = 1.0 / 6, twelfth = 1.0 / 12;
  const std::vector<double> expected = {-half,  0,     0,      0,      -half,    0,        0,
                                        0,      -half, -sixth, -sixth, 0,        -sixth,   0,
                                        -sixth, 0,     -sixth, -sixth, -twelfth, -twelfth, -twelfth};
  ASSERT_EQ(vector.size(), expected.size());
  for (std::size_t i = 0; i < vector.size(); ++i) EXPECT_NEAR(vector[i], expected[i], 1e-15) << i;
}

TEST(Arrows, are_as_many_as_pairs) {
  const OutputsOf of =
      outputs_of(octahedron(), {10, 5, -5, 1, 2, 3, 4});  // 7 vertices, 18 edges, 20 triangles, 8 tetrahedra
  const auto critical = of.complex.critical.counts();
  const auto dimensions =
      values_of<std::int8_t>(outputs::arrows_of(of.dataset, of.complex.gradient).arrays, "CellDimension");
  EXPECT_EQ(2 * dimensions.size(), 7u + 18 + 20 + 8 - (critical[0] + critical[1] + critical[2] + critical[3]));
  EXPECT_EQ(std::count(dimensions.begin(), dimensions.end(), 0), 7 - critical[0]);
  EXPECT_EQ(std::count(dimensions.begin(), dimensions.end(), 2), 8 - critical[3]);
}

}  // namespace gale::test
