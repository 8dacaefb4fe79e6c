#include <gtest/gtest.h>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/base/error.hpp>
#include <gale/base/threads.hpp>
#include <gale/runtime/make_structure.hpp>

#include "algorithms/fields.hpp"
#include "algorithms/gradient_reader.hpp"
#include "algorithms/structure_kinds.hpp"
#include "support/every_mesh.hpp"

namespace gale::test {

namespace {

/// The pairs of each of fields_on a mesh, by brute force.
const std::vector<PairTable>& brute_force_pairs(const std::string& mesh_name) {
  static std::map<std::string, std::vector<PairTable>> known;
  std::vector<PairTable>& tables = known[mesh_name];
  if (tables.empty()) {
    for (const BruteForceGradient& gradient : brute_force_gradients(mesh_name)) {
      tables.push_back(pairs_of(gradient, brute_force_of(mesh_name)));
    }
  }
  return tables;
}

}  // namespace

class DiscreteGradientOf : public EveryMesh {};

TEST_P(DiscreteGradientOf, every_mesh_is_that_of_brute_force_on_every_structure) {
  const Mesh mesh = encode(input(), segmentation());
  const GradientReader reader(brute_force_of(mesh_name()), mesh);
  const auto& expected = brute_force_pairs(mesh_name());
  const auto fields = fields_on(input());
  std::vector<DiscreteGradient> first;
  for (const auto& kind : structure_kinds()) {
    const auto structure = kind.make(mesh, discrete_gradient_relations);
    for (std::size_t i = 0; i < fields.size(); ++i) {
      SCOPED_TRACE(kind.name + ", " + fields[i].name);
      const auto floats = fields[i].floats();
      const VertexOrder of_doubles(mesh, fields[i].values.data(), fields[i].values.size());
      const VertexOrder of_floats(mesh, floats.data(), floats.size());
      const auto one_thread = find_discrete_gradient(*structure, of_doubles, with_threads(1));
      const auto eight_threads = find_discrete_gradient(*structure, of_floats, with_threads(8));
      if (first.size() == i) {
        first.push_back(one_thread);
        ASSERT_TRUE(reader.match(one_thread, expected[i]));
      } else {
        EXPECT_TRUE(reader.equal(one_thread, first[i]));
      }
      EXPECT_TRUE(reader.equal(eight_threads, first[i]));
    }
  }
}

TEST_P(DiscreteGradientOf, the_workers_space_is_that_of_consumers) {
  const Mesh mesh = encode(input(), segmentation());
  const GradientReader reader(brute_force_of(mesh_name()), mesh);
  const auto structure = make_structure(mesh, discrete_gradient_relations);
  DeviceSweepOptions small;
  small.memory = 1 << 16;
  for (const Field& field : fields_on(input())) {
    SCOPED_TRACE(field.name);
    const VertexOrder order(mesh, field.values.data(), field.values.size());
    const DiscreteGradient expected = find_discrete_gradient(*structure, order);
    for (const DeviceSweepOptions& options : {DeviceSweepOptions(), small}) {
      const DiscreteGradient found = find_discrete_gradient(WorkerSpace(), order, options);
      EXPECT_TRUE(reader.equal(found, expected));
      EXPECT_EQ(found.critical().star, expected.critical().star);
      EXPECT_EQ(found.critical().star_begin, expected.critical().star_begin);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, DiscreteGradientOf, every_mesh_and_segmentations_in_turn(), mesh_and_segmentation);

TEST(DiscreteGradient, needs_the_relations_that_it_reads) {
  const Mesh mesh = encode(mesh_named("one_tetrahedron"), 100);
  const std::vector<float> field(4, 1.0f);
  const auto runtime = make_structure(mesh, Relation::VV);
  EXPECT_THROW(find_discrete_gradient(*runtime, VertexOrder(mesh, field.data(), field.size())), Error);
}

/// Where Kokkos has Serial alone it doesn't count references atomically.
TEST(DiscreteGradient, is_read_on_many_threads_without_counting_references) {
  const Mesh mesh = encode(mesh_named("one_tetrahedron"), 100);
  const std::vector<float> field = {0, 1, 2, 3};
  const auto runtime = make_structure(mesh, discrete_gradient_relations);
  const auto gradient = find_discrete_gradient(*runtime, VertexOrder(mesh, field.data(), field.size()));
  const auto mine = gradient.vertex_successors(), mine_too = gradient.cell_successors();
  const int before = mine.use_count(), before_too = mine_too.use_count();
  on_threads(8, [&](int) {
    for (int i = 0; i < 100000; ++i) {
      EXPECT_EQ(gradient.vertex_successors().data(), mine.data());
      EXPECT_EQ(gradient.cell_successors().data(), mine_too.data());
    }
  });
  EXPECT_EQ(mine.use_count(), before);
  EXPECT_EQ(mine_too.use_count(), before_too);
}

}  // namespace gale::test
