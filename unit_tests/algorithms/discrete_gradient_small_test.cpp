#include <numeric>

#include <gtest/gtest.h>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/runtime/make_structure.hpp>

#include "algorithms/fields.hpp"
#include "algorithms/gradient_reader.hpp"
#include "support/segmentations.hpp"

// Gradients that a reader can find by hand, and those of large stars.

namespace gale::test {

namespace {

DiscreteGradient gradient_on(const Mesh& mesh, const std::vector<double>& field) {
  const auto runtime = make_structure(mesh, discrete_gradient_relations);
  return find_discrete_gradient(*runtime, VertexOrder(mesh, field.data(), field.size()));
}

/// GALE's tetrahedron of an input id.
Id cell_of(const Mesh& mesh, Id input) {
  Id t = 0;
  while (mesh.cell_input()(t) != input) ++t;
  return t;
}

/// With the middle of the cone highest or lowest.
std::vector<double> with_apex(std::vector<double> field, double value) {
  field[0] = value;
  return field;
}

/// Input ids.
std::vector<double> ids_of(const InputMesh& mesh) {
  std::vector<double> ids(mesh.points.size());
  std::iota(ids.begin(), ids.end(), 0);
  return ids;
}

std::array<Id, 4> counts_on(const InputMesh& input, const std::vector<double>& field) {
  return gradient_on(encode(input, 100), field).critical().counts();
}

}  // namespace

/// With 3 > 2 > 1 > 0: 1 has 10, 2 has 20, 21 has 210, 3 has 30, 31 has 310, 32 has 320, and 321 has 3210.
TEST(DiscreteGradient, of_one_tetrahedron_leaves_through_its_highest_triangle) {
  const InputMesh& input = mesh_named("one_tetrahedron");
  for (const auto& name : segmentation_names()) {
    const Mesh mesh = encode(input, segmentation_named(name, input));
    const auto gradient = gradient_on(mesh, ids_of(input));
    const auto id = [&](Id vertex) { return mesh.vertex_internal()(vertex); };
    EXPECT_EQ(gradient.critical().vertices, std::vector<Id>{id(0)});
    EXPECT_EQ(gradient.critical().counts(), (std::array<Id, 4>{1, 0, 0, 0}));
    EXPECT_TRUE(gradient.pair_of_vertex(id(0)).is_critical());
    EXPECT_EQ(gradient.vertex_successor(id(0)), no_id);
    EXPECT_EQ(gradient.vertex_successor(id(1)), id(0));
    EXPECT_EQ(gradient.vertex_successor(id(2)), id(0));
    EXPECT_EQ(gradient.vertex_successor(id(3)), id(0));
    EXPECT_EQ(gradient.pair_of_edge(id(0), id(3)).dimension, 0);
    EXPECT_EQ(gradient.pair_of_edge(id(0), id(3)).vertex, id(0));
    EXPECT_EQ(gradient.triangle_of_edge(id(0), id(3)), no_id);
    EXPECT_EQ(gradient.triangle_of_edge(id(1), id(2)), id(0));
    EXPECT_EQ(gradient.triangle_of_edge(id(3), id(1)), id(0));
    EXPECT_EQ(gradient.triangle_of_edge(id(2), id(3)), id(0));
    EXPECT_EQ(gradient.pair_of_cell(0).dimension, 2);
    EXPECT_EQ(gradient.pair_of_cell(0).vertex, id(0));
    EXPECT_TRUE(DiscreteGradient::leaves(gradient.cell_successor(0)));
    for (int corner = 0; corner < 4; ++corner) {
      const Partner pair = gradient.pair_of_triangle(0, corner, {});
      const bool is_321 = mesh.encoded().cells(0, corner) == id(0);
      EXPECT_EQ(pair.dimension, is_321 ? 3 : 1);
      if (is_321) EXPECT_EQ(pair.vertex, id(0));
    }
  }
}

TEST(DiscreteGradient, leaves_through_neither_a_critical_nor_an_inner_simplex) {
  EXPECT_FALSE(DiscreteGradient::leaves(no_id));
  EXPECT_FALSE(DiscreteGradient::leaves(0));
  EXPECT_FALSE(DiscreteGradient::leaves(2147483647));
}

/// Tetrahedra 0123, 0124 and 0125, and 0 is the highest vertex, 5 the lowest. 0 has 05, 02 has 025, 04 has 024, 03 has
/// 023, 01 has 015; so the first tetrahedron that has one triangle left is 0125, with 012. Then 0124 has 014 and 0123
/// has 013. 3, 4 and 5 are minima, which two edges of 2 join.
TEST(DiscreteGradient, goes_on_in_the_tetrahedron_of_lowest_input_id_across_a_triangle_of_three) {
  const InputMesh& input = mesh_named("three_on_one_triangle");
  for (const auto& name : segmentation_names()) {
    const Mesh mesh = encode(input, segmentation_named(name, input));
    const auto gradient = gradient_on(mesh, {0, -1, -2, -3, -4, -5});
    const auto id = [&](Id vertex) { return mesh.vertex_internal()(vertex); };
    const Id first = cell_of(mesh, 0), second = cell_of(mesh, 1), third = cell_of(mesh, 2);
    EXPECT_EQ(gradient.cell_successor(third), first) << name;
    EXPECT_EQ(gradient.pair_of_cell(third).vertex, id(5)) << name;
    EXPECT_TRUE(DiscreteGradient::leaves(gradient.cell_successor(first))) << name;
    EXPECT_TRUE(DiscreteGradient::leaves(gradient.cell_successor(second))) << name;
    EXPECT_EQ(gradient.pair_of_cell(second).vertex, id(2)) << name;
    EXPECT_EQ(gradient.pair_of_cell(first).vertex, id(2)) << name;
    EXPECT_EQ(gradient.critical().counts(), (std::array<Id, 4>{3, 2, 0, 0})) << name;
  }
}

/// A vertex with as many neighbours, the highest or the lowest of all.
class GradientOfStar : public testing::TestWithParam<Id> {};

TEST_P(GradientOfStar, of_each_degree_is_that_of_brute_force) {
  const Id degree = GetParam();
  for (const InputMesh& input : {cone_over_disc(degree), cone_over_caps(degree, 2), cone_over_caps(degree, 3)}) {
    const BruteForce brute_force(input);
    const Mesh mesh = encode(input, 100);
    const GradientReader reader(brute_force, mesh);
    for (const double apex : {-1.0, 1e6}) {
      const auto field = with_apex(random_field(input, degree), apex);
      EXPECT_TRUE(reader.match(gradient_on(mesh, field), pairs_of(BruteForceGradient(input, field), brute_force)));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, GradientOfStar, testing::Values(20, 33, 64, 65, 128, 129, 200, 256, 257, 2000));

/// Whatever the order of the others, a cone shrinks to its apex.
TEST(DiscreteGradient, of_a_cone_with_its_lowest_vertex_in_the_middle_has_no_other_critical_simplex) {
  for (const Id degree : {200, 20000}) {
    for (const InputMesh& input : {cone_over_disc(degree), cone_over_caps(degree, 2), cone_over_caps(degree, 3)}) {
      EXPECT_EQ(counts_on(input, with_apex(random_field(input, 1), -1)), (std::array<Id, 4>{1, 0, 0, 0}));
    }
  }
}

/// On the sphere, whose vertices rise from one pole around the equator to the other, the lowest vertex and a triangle
/// are critical; the apex fills it with a critical tetrahedron. Each further cap is a further sphere.
TEST(DiscreteGradient, of_a_cone_over_spheres_with_its_highest_vertex_in_the_middle_fills_each) {
  for (const Id degree : {200, 2000, 20000}) {
    for (const int caps : {2, 3}) {
      const InputMesh input = cone_over_caps(degree, caps);
      auto field = with_apex(ids_of(input), 1e9);
      for (int cap = 1; cap < caps; ++cap) field[1 + cap] = 1e6 + cap;
      const Id spheres = caps - 1;
      EXPECT_EQ(counts_on(input, field), (std::array<Id, 4>{1, 0, spheres, spheres})) << degree << ", " << caps;
    }
    const InputMesh disc = cone_over_disc(degree);
    EXPECT_EQ(counts_on(disc, with_apex(ids_of(disc), 1e9)), (std::array<Id, 4>{1, 0, 0, 0})) << degree;
  }
}

}  // namespace gale::test
