#include <map>

#include <gtest/gtest.h>

#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/persistence.hpp>
#include <gale/baselines/discrete_gradient_from_cells.hpp>
#include <gale/io/synthetic.hpp>

#include "algorithms/brute_force_persistence.hpp"
#include "algorithms/fields.hpp"
#include "algorithms/named_complex.hpp"
#include "algorithms/structure_kinds.hpp"
#include "support/every_mesh.hpp"

namespace gale::test {

namespace {

DiscreteGradient gradient_by_structure(const Mesh& mesh, const std::vector<double>& field) {
  const auto structure = structure_kinds().front().make(mesh, discrete_gradient_relations);
  return find_discrete_gradient(*structure, VertexOrder(mesh, field.data(), field.size()));
}

/// Each simplex is in one pair or essential, and lists are in order.
void expect_partition(const CriticalSimplices& critical, const PersistencePairs& found) {
  std::array<std::multiset<Id>, 4> places;
  for (int d = 0; d < 3; ++d) {
    EXPECT_TRUE(std::is_sorted(found.pairs[d].begin(), found.pairs[d].end(),
                               [](const auto& a, const auto& b) { return a.lower < b.lower; }));
    for (const auto& pair : found.pairs[d]) {
      places[d].insert(pair.lower);
      places[d + 1].insert(pair.upper);
    }
  }
  for (int d = 0; d < 4; ++d) {
    EXPECT_TRUE(std::is_sorted(found.essential[d].begin(), found.essential[d].end()));
    places[d].insert(found.essential[d].begin(), found.essential[d].end());
    std::multiset<Id> expected;
    for (Id i = 0; i < critical.counts()[d]; ++i) expected.insert(i);
    EXPECT_EQ(places[d], expected) << "of dimension " << d;
  }
}

void expect_equal(const NamedPairs& found, const NamedPairs& expected) {
  for (int d = 0; d < 3; ++d) EXPECT_EQ(found.pairs[d], expected.pairs[d]) << "of type " << d;
  for (int d = 0; d < 4; ++d) EXPECT_EQ(found.essential[d], expected.essential[d]) << "of dimension " << d;
}

}  // namespace

class PersistencePairsOf : public EveryMesh {};

TEST_P(PersistencePairsOf, every_mesh_are_those_of_brute_force_whatever_segments_and_threads) {
  static std::map<std::pair<std::string, std::string>, NamedPairs> known;
  const Mesh mesh = encode(input(), segmentation());
  const auto fields = fields_on(input());
  for (std::size_t i = 0; i < fields.size(); ++i) {
    SCOPED_TRACE(fields[i].name);
    const DiscreteGradient gradient = gradient_by_structure(mesh, fields[i].values);
    const PersistencePairs found = find_persistence_pairs(gradient, with_threads(i % 2 == 0 ? 1 : 8));
    expect_partition(gradient.critical(), found);
    const auto [expected, is_new] = known.try_emplace({mesh_name(), fields[i].name});
    if (is_new) expected->second = brute_force_pairs(fields[i].values, brute_force_gradients(mesh_name())[i]);
    expect_equal(named_pairs(gradient, found), expected->second);
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, PersistencePairsOf, every_mesh_and_segmentations_in_turn(), mesh_and_segmentation);

class PersistencePairsWithoutGradient : public testing::TestWithParam<std::string> {};

/// Finds the homology from all simplices.
TEST_P(PersistencePairsWithoutGradient, begin_and_end_at_the_same_vertices) {
  const InputMesh& input = mesh_named(GetParam());
  const Mesh mesh = encode(input, 50);
  for (const unsigned seed : {0, 1, 2}) {
    const auto field = seed == 0 ? fields_on(input)[0].values : random_field(input, seed);
    const DiscreteGradient gradient = gradient_by_structure(mesh, field);
    const NamedPairs found = named_pairs(gradient, find_persistence_pairs(gradient));
    EXPECT_EQ(vertex_pairs(field, found), brute_force_vertex_pairs(input, field)) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, PersistencePairsWithoutGradient, testing::ValuesIn(mesh_names()),
                         [](const auto& info) { return info.param; });

TEST(PersistencePairs, of_noise_are_the_same_with_any_number_of_threads_and_from_cells) {
  const InputMesh input = holed_grid(20);
  const Mesh mesh = encode(input, 100);
  const auto field = random_field(input, 7);
  const DiscreteGradient gradient = gradient_by_structure(mesh, field);
  const PersistencePairs one = find_persistence_pairs(gradient, with_threads(1));
  expect_partition(gradient.critical(), one);
  EXPECT_GT(one.essential[1].size(), 0u);
  EXPECT_GT(one.pairs[1].size(), 1000u);
  for (const int threads : {2, 3, 8}) {
    for (int turn = 0; turn < 3; ++turn) {
      const PersistencePairs again = find_persistence_pairs(gradient, with_threads(threads));
      EXPECT_EQ(again.pairs, one.pairs);
      EXPECT_EQ(again.essential, one.essential);
    }
  }
  const auto structure = structure_kinds().front().make(mesh, discrete_gradient_from_cells_relations);
  const auto from_cells = find_discrete_gradient_from_cells(*structure, VertexOrder(mesh, field.data(), field.size()));
  EXPECT_EQ(find_persistence_pairs(from_cells).pairs, one.pairs);
}

TEST(PersistencePairs, of_forked_paths_are_the_same_from_cells) {
  for (const char* name : {"three_on_one_triangle", "seven_on_one_triangle", "cone_over_three_caps_100"}) {
    SCOPED_TRACE(name);
    const InputMesh& input = mesh_named(name);
    const Mesh mesh = encode(input, 50);
    for (const Field& field : fields_on(input)) {
      const auto structure = structure_kinds().front().make(mesh, discrete_gradient_from_cells_relations);
      const auto gradient =
          find_discrete_gradient_from_cells(*structure, VertexOrder(mesh, field.values.data(), field.values.size()));
      EXPECT_EQ(find_persistence_pairs(gradient).pairs,
                find_persistence_pairs(gradient_by_structure(mesh, field.values)).pairs);
    }
  }
}

/// As TTK's Discrete Morse Sandwich counts them.
TEST(PersistencePairs, of_a_known_grid) {
  const io::Dataset dataset = io::make_grid(64);
  const auto& points = std::get<io::Dataset::Points<float>>(dataset.points);
  const auto& values = std::get<std::vector<float>>(dataset.arrays.front().values);
  const Mesh mesh(Tetrahedra<Id, HostMemory>(dataset.tetrahedra),
                  octree_segmentation<float, HostMemory>(Points<float, HostMemory>(points), 100));
  const std::vector<double> field(values.begin(), values.end());
  const PersistencePairs found = find_persistence_pairs(gradient_by_structure(mesh, field));
  EXPECT_EQ(found.pairs[0].size(), 133u);
  EXPECT_EQ(found.pairs[1].size(), 223u);
  EXPECT_EQ(found.pairs[2].size(), 40u);
  EXPECT_EQ(found.essential[0].size(), 1u);
  for (int d = 1; d < 4; ++d) EXPECT_TRUE(found.essential[d].empty());
}

}  // namespace gale::test
