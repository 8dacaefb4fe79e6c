#include <map>
#include <set>

#include <gale/algorithms/simplify.hpp>
#include <gale/runtime/make_structure.hpp>

#include "algorithms/brute_force_simplify.hpp"
#include "algorithms/complexes.hpp"
#include "support/message_of.hpp"
#include "support/segmentations.hpp"

namespace gale::test {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Id euler(const std::array<Id, 4>& counts) { return counts[0] - counts[1] + counts[2] - counts[3]; }

/// Tetrahedra i, i+1, i+2, i+3, one after the other: a vertex has an edge with those at most three further.
InputMesh strip(Id vertices) {
  InputMesh mesh;
  for (Id v = 0; v < vertices; ++v) mesh.points.push_back({0.3 * v, double(v % 2), double(v % 3)});
  for (Id v = 0; v + 3 < vertices; ++v) mesh.tetrahedra.push_back({v + 1, v, v + 3, v + 2});
  return mesh;
}

std::vector<Simplex> all_equal(std::size_t count, const Simplex& simplex) {
  return std::vector<Simplex>(count, simplex);
}

}  // namespace

TEST(Simplify, of_two_minima_keeps_the_lower) {
  // 1 falls to 0. 4 falls to 5, its lowest neighbour, and (1, 4) is in no triangle with either: the saddle. 2 and 3 are
  // above all of their neighbours but one another.
  const ComplexOf found(strip(6), {0, 2, 4, 5, 3, 1});
  EXPECT_EQ(found.all().critical, (std::array<std::vector<Simplex>, 4>{{{{0}, {5}}, {{1, 4}}, {}, {}}}));
  ASSERT_EQ(found.all().descending.size(), 2u);
  EXPECT_EQ(found.all().descending[0].cells, (std::vector<Simplex>{{1}, {0}}));
  EXPECT_EQ(found.all().descending[1].cells, (std::vector<Simplex>{{4}, {5}}));
  EXPECT_EQ(found.all().descending_manifold, (std::vector<Simplex>{{0}, {0}, {0}, {0}, {5}, {5}}));
  EXPECT_TRUE(equal(found.simplified(2), found.all())) << "what isn't below the threshold stays";
  const NamedComplex left = found.simplified(2.1);  // 5 and the saddle: 3 - 1
  EXPECT_EQ(left.critical, (std::array<std::vector<Simplex>, 4>{{{{0}}, {}, {}, {}}}));
  EXPECT_TRUE(left.descending.empty());
  EXPECT_EQ(left.descending_manifold, all_equal(6, {0}));
}

TEST(Simplify, joins_paths_over_the_minimum_that_goes) {
  // Minima 0 (value 0), 5 (value 2) and 10 (value 1); saddles (1, 4) of value 4 and (6, 9) of value 6.
  const ComplexOf found(strip(11), {0, 3, 7, 8, 4, 2, 5, 9, 10, 6, 1});
  EXPECT_EQ(found.all().critical, (std::array<std::vector<Simplex>, 4>{{{{0}, {5}, {10}}, {{1, 4}, {6, 9}}, {}, {}}}));
  EXPECT_TRUE(equal(found.simplified(2), found.all()));
  const NamedComplex left = found.simplified(5);  // 5 with (1, 4), 4 - 2; but not 10 with (6, 9), 6 - 1
  EXPECT_EQ(left.critical, (std::array<std::vector<Simplex>, 4>{{{{0}, {10}}, {{6, 9}}, {}, {}}}));
  ASSERT_EQ(left.descending.size(), 2u);
  EXPECT_EQ(left.descending[0].source, (Simplex{6, 9}));
  EXPECT_EQ(with_sorted_paths(left).descending[0].cells, (std::vector<Simplex>{{6}, {5}, {4}, {1}, {0}}));
  EXPECT_EQ(with_sorted_paths(left).descending[1].cells, (std::vector<Simplex>{{9}, {10}}));
  EXPECT_EQ(left.descending_manifold[5], (Simplex{0}));
  EXPECT_EQ(left.descending_manifold[9], (Simplex{10}));
  const NamedComplex one = found.simplified(5.1);
  EXPECT_EQ(one.critical, (std::array<std::vector<Simplex>, 4>{{{{0}}, {}, {}, {}}}));
  EXPECT_EQ(one.descending_manifold, all_equal(11, {0}));
}

namespace {

/// With each of fields_on it.
void expect_that_of_brute_force(const InputMesh& input) {
  for (const Field& field : fields_on(input)) {
    const ComplexOf found(input, field.values);
    EXPECT_TRUE(equal(found.simplified(0), found.all())) << field.name;
    std::array<Id, 4> before = found.all().counts();
    const double most = field.name == "permutation" ? input.vertices() : 20;
    for (const double threshold : {1e-9, 0.05 * most, 0.4 * most, infinity}) {
      SCOPED_TRACE(field.name + ", threshold " + std::to_string(threshold));
      const NamedComplex left = found.simplified(threshold);
      const NamedComplex expected = brute_force_simplified(found.all(), field.values, threshold);
      EXPECT_TRUE(equal(as_defined(with_sorted_paths(left)), expected));
      const auto counts = left.counts();
      EXPECT_EQ(euler(counts), euler(before));
      for (int d = 0; d < 4; ++d) EXPECT_LE(counts[d], before[d]) << "of dimension " << d;
      before = counts;
    }
  }
}

}  // namespace

class SimplifyOf : public testing::TestWithParam<std::string> {};

TEST_P(SimplifyOf, every_field_is_that_of_brute_force) { expect_that_of_brute_force(mesh_named(GetParam())); }

INSTANTIATE_TEST_SUITE_P(Tests, SimplifyOf,
                         testing::Values("the_papers", "three_on_one_triangle", "seven_on_one_triangle",
                                         "several_components", "isolated_vertices", "slivers", "cone_over_disc_200",
                                         "cone_over_sphere_200", "cone_over_three_caps_100", "ball", "solid_torus",
                                         "thick_shell"),
                         [](const auto& info) { return info.param; });

/// Where paths are joined over and over: written out one after the other, they would fill the memory.
TEST(Simplify, of_noise_is_that_of_brute_force) { expect_that_of_brute_force(holed_grid(7)); }

TEST(Simplify, of_noise_leaves_few) {
  const InputMesh input = holed_grid(12);
  const ComplexOf found(input, random_field(input, 3));
  const NamedComplex left = found.simplified(infinity);
  EXPECT_EQ(euler(left.counts()), euler(found.all().counts()));
  EXPECT_LT(left.critical[0].size() * 20, found.all().critical[0].size());
  for (const auto* paths : {&left.descending, &left.ascending, &left.connectors}) {
    for (const auto& path : *paths) {
      EXPECT_EQ(std::set<Simplex>(path.cells.begin(), path.cells.end()).size(), path.cells.size());
    }
  }
}

TEST(Simplify, leaves_pairs_that_would_make_too_many_paths) {
  const InputMesh input = holed_grid(9);
  const ComplexOf found(input, fields_on(input).back().values);
  const NamedComplex left = found.simplified(infinity);
  EXPECT_TRUE(equal(as_defined(with_sorted_paths(left)), brute_force_simplified(found.all(), found.field(), infinity)));
  std::map<std::pair<Simplex, Simplex>, int> between;
  for (const auto& path : left.connectors) {
    between[{path.source, path.destination}] += path.is_only ? 1 : 2;
  }
  int single = 0;
  for (const auto& [ends, count] : between) single += count == 1;
  EXPECT_GT(single, 0);
}

TEST(Simplify, refuses_a_complex_without_the_parts_that_it_needs) {
  const InputMesh input = strip(6);
  const Mesh mesh = encode(input, octree_of(input, 50));
  const auto runtime = make_structure(mesh, morse_smale_relations);
  const std::vector<double> field = {0, 2, 4, 5, 3, 1};
  const auto gradient = find_discrete_gradient(*runtime, VertexOrder(mesh, field.data(), field.size()));
  const auto message = [&](const MorseSmaleParts& parts) {
    return message_of([&] {
      simplify(
          find_morse_smale_complex(*runtime, gradient, parts), [&](Id v) { return field.at(v); }, 5);
    });
  };
  const std::string refusal = "simplify needs parts that the complex was computed without: ";
  MorseSmaleParts parts;
  parts.descending_manifolds = parts.ascending_manifolds = false;
  EXPECT_EQ(message(parts), "no error");
  parts.saddle_connectors = false;
  EXPECT_EQ(message(parts), refusal + "saddle connectors");
  parts.descending_separatrices = parts.ascending_separatrices = false;
  EXPECT_EQ(message(parts), refusal + "descending separatrices, ascending separatrices, saddle connectors");
}

}  // namespace gale::test
