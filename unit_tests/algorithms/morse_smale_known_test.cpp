#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "algorithms/complexes.hpp"
#include "support/voxel_shapes.hpp"

// Fields whose complex can be told by hand. Without noise, critical simplices that are of no account have pairs of
// persistence 0.

namespace gale::test {

namespace {

constexpr double tiny = 1e-6;

using Counts = std::array<Id, 4>;

/// How far a point is from another along the axis along which it is furthest.
double distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

/// Noise of at most `size`, which depends on the position.
double noise(double x, double y, double z, double size) {
  return size * (0.5 + 0.5 * std::sin(12.9898 * x + 78.233 * y + 37.719 * z) * std::cos(93.9 * x * y + 17.1 * z));
}

}  // namespace

TEST(MorseSmaleComplex, of_one_hill_in_a_ball_has_its_top_and_the_valley_around) {
  // The lowest part is the whole surface, a sphere: a minimum, and a 2-saddle that closes it. The top fills it.
  const InputMesh input = ball(6);
  const ComplexOf found(input, field_by(input, [](double x, double y, double z) {
                          return -distance({x, y, z}, {3, 3, 3});
                        }));
  const NamedComplex left = found.simplified(tiny);
  EXPECT_EQ(left.counts(), (Counts{1, 0, 1, 1}));
  EXPECT_TRUE(left.descending.empty());
  EXPECT_TRUE(left.connectors.empty());
  ASSERT_EQ(left.ascending.size(), 1u) << "the other one leaves through the surface";
  EXPECT_EQ(left.ascending[0].destination, left.critical[3][0]);
  EXPECT_TRUE(std::any_of(left.critical[3][0].begin(), left.critical[3][0].end(), [&](Id v) {
    return distance(input.points[v], {3, 3, 3}) == 0;
  }));
  EXPECT_EQ(found.simplified(3).counts(), (Counts{1, 0, 1, 1})) << "the hill's height isn't below itself";
  EXPECT_EQ(found.simplified(3 + tiny).counts(), (Counts{1, 0, 0, 0})) << "a ball's Betti numbers";
}

TEST(MorseSmaleComplex, of_two_hills_has_two_maxima_and_a_pass) {
  // The hills' heights are 3 (at x = 3) and 2.5 (at x = 8). Between them the higher one falls to 1 at x = 5, the lower
  // one to 0.5 at x = 6: the pass.
  const InputMesh input = voxels(12, 6, 6, [](Id, Id, Id) { return true; });
  const ComplexOf found(input, field_by(input, [](double x, double y, double z) {
                          return std::max(3 - distance({x, y, z}, {3, 3, 3}), 2.5 - distance({x, y, z}, {8, 3, 3}));
                        }));
  const NamedComplex two = found.simplified(tiny);
  EXPECT_EQ(two.counts(), (Counts{1, 0, 2, 2}));
  EXPECT_EQ(found.simplified(2).counts(), (Counts{1, 0, 2, 2})) << "the lower hill rises by 2 above the pass";
  const NamedComplex one = found.simplified(2 + tiny);
  EXPECT_EQ(one.counts(), (Counts{1, 0, 1, 1}));
  EXPECT_EQ(std::set<Simplex>(one.ascending_manifold.begin(), one.ascending_manifold.end()).count(one.critical[3][0]),
            1u);
  const std::set<Simplex> tops(two.ascending_manifold.begin(), two.ascending_manifold.end());
  for (const Simplex& maximum : two.critical[3]) EXPECT_EQ(tops.count(maximum), 1u);
  // The pass: a 2-saddle with a path to each.
  std::map<Simplex, std::set<Simplex>> tops_of;
  for (const auto& path : two.ascending) tops_of[path.source].insert(path.destination);
  EXPECT_TRUE(std::any_of(tops_of.begin(), tops_of.end(),
                          [](const auto& one_saddle) { return one_saddle.second.size() == 2; }));
}

struct Shape {
  const char* name;
  InputMesh (*make)(Id);
  Counts betti_numbers;
};

class SlopeOn : public testing::TestWithParam<Shape> {};

TEST_P(SlopeOn, a_shape_leaves_its_Betti_numbers) {
  const Shape& shape = GetParam();
  const InputMesh input = shape.make(6);
  const ComplexOf plain(input, field_by(input, [](double x, double y, double z) { return x + 0.1 * y + 0.01 * z; }));
  EXPECT_EQ(plain.simplified(tiny).counts(), shape.betti_numbers);
  const ComplexOf noisy(input, field_by(input, [](double x, double y, double z) {
                          return x + 0.1 * y + 0.01 * z + noise(x, y, z, 0.9);
                        }));
  EXPECT_GT(noisy.all().counts()[1], shape.betti_numbers[1] + 3) << "there is noise";
  EXPECT_EQ(noisy.simplified(std::numeric_limits<double>::infinity()).counts(), shape.betti_numbers);
  const ComplexOf constant(input, std::vector<double>(input.points.size(), 7.0));
  EXPECT_EQ(constant.simplified(tiny).counts(), shape.betti_numbers);
}

INSTANTIATE_TEST_SUITE_P(Tests, SlopeOn,
                         testing::Values(Shape{"ball", ball, {1, 0, 0, 0}},
                                         Shape{"solid_torus", solid_torus, {1, 1, 0, 0}},
                                         Shape{"thick_shell", thick_shell, {1, 0, 1, 0}}),
                         [](const auto& info) { return info.param.name; });

}  // namespace gale::test
