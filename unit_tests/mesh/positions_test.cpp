#include <gtest/gtest.h>

#include <gale/base/memory.hpp>
#include <gale/mesh/positions.hpp>

namespace gale::test {

namespace {

using detail::Point;
using detail::position_of;

template <class Coordinate>
using PointsOf = Kokkos::View<Coordinate* [3], Kokkos::LayoutRight, HostMemory>;

template <class Coordinate>
PointsOf<Coordinate> points(const std::vector<Point>& all) {
  const PointsOf<Coordinate> points("points", all.size());
  for (std::size_t i = 0; i < all.size(); ++i) detail::store(all[i], points, i);
  return points;
}

}  // namespace

TEST(Positions, of_simplices_of_each_dimension) {
  const auto all = points<double>({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {1, 0, 8}});
  EXPECT_EQ(position_of(all, std::array<Id, 1>{1}), (Point{3, 0, 0}));
  EXPECT_EQ(position_of(all, std::array<Id, 2>{1, 2}), (Point{1.5, 2, 0})) << "the middle";
  EXPECT_EQ(position_of(all, std::array<Id, 4>{0, 1, 2, 3}), (Point{1, 1, 2})) << "the barycentre";
}

TEST(Positions, a_triangle_is_drawn_at_its_incentre) {
  const auto all = points<double>({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}});  // right-angled, of inradius (3 + 4 - 5) / 2
  const Point centre = position_of(all, std::array<Id, 3>{0, 1, 2});
  EXPECT_NEAR(centre[0], 1, 1e-15);
  EXPECT_NEAR(centre[1], 1, 1e-15);
  EXPECT_EQ(centre[2], 0);
}

TEST(Positions, a_triangle_without_extent_is_at_its_corner) {
  const auto all = points<float>({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}});
  EXPECT_EQ(position_of(all, std::array<Id, 3>{0, 1, 2}), (Point{1, 2, 3}));
}

TEST(Positions, are_the_same_to_the_last_bit_in_any_order_of_the_vertices) {
  const auto all = points<double>({{0.1, 0.7, 1e9}, {1e-9, 0.3, 0.3}, {0.2, 1e5, 0.6}, {0.9, 0.11, 7e3}});
  std::array<Id, 3> triangle{0, 1, 2};
  std::array<Id, 4> tetrahedron{0, 1, 2, 3};
  const Point centre = position_of(all, triangle), middle = position_of(all, tetrahedron);
  do {
    EXPECT_EQ(position_of(all, triangle), centre);
  } while (std::next_permutation(triangle.begin(), triangle.end()));
  do {
    EXPECT_EQ(position_of(all, tetrahedron), middle);
  } while (std::next_permutation(tetrahedron.begin(), tetrahedron.end()));
}

}  // namespace gale::test
