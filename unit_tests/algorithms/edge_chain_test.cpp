#include <limits>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/persistence/edge_chain.hpp>
#include <gale/mesh/grid.hpp>

#include "algorithms/fields.hpp"
#include "support/every_mesh.hpp"

namespace gale::test {

namespace {

using Edges = std::set<std::pair<Id, Id>>;

/// Adds an edge to a sum over Z2.
void add(Edges& sum, Id high, Id low) {
  const auto [at, is_new] = sum.insert({high, low});
  if (!is_new) sum.erase(at);
}

void no_other_rank(Id, Id) { FAIL() << "on one rank"; }

/// Lets the rims of two 2-saddles of three fall together (those of all may leave nothing), as one sum and in parts.
/// Returns how many parts there were.
int expect_the_same_in_parts(const DiscreteGradient& gradient) {
  const detail::EdgeChain empty(gradient);
  std::vector<detail::LowerEdge> rims;
  const auto& triangles = gradient.critical().triangles;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (t % 3 == 2) continue;
    const auto& [high, middle, low] = triangles[t];
    for (const detail::LowerEdge& edge : {detail::LowerEdge{high, middle}, {high, low}, {middle, low}})
      rims.push_back(edge);
  }
  detail::EdgeChain whole = empty;
  whole.add(rims);
  Edges expected, in_parts;
  EXPECT_FALSE(whole.fall_from(
      std::numeric_limits<int>::max(), [&](Id high, Id low) { add(expected, high, low); }, no_other_rank));
  std::vector<std::vector<detail::LowerEdge>> left{rims};
  int parts = 0;
  for (; !left.empty(); ++parts) {
    detail::EdgeChain part = empty;
    part.add(left.back());
    left.pop_back();
    while (part.fall_from(
        2, [&](Id high, Id low) { add(in_parts, high, low); }, no_other_rank)) {
      const std::size_t before = part.size();
      if (before < 8) continue;
      left.push_back(part.split());
      EXPECT_EQ(left.back().size() + part.size(), before);
      EXPECT_FALSE(left.back().empty());
    }
  }
  EXPECT_EQ(in_parts, expected);
  return parts;
}

}  // namespace

class EdgeChainOf : public EveryMesh {};

TEST_P(EdgeChainOf, every_mesh_falls_in_parts_as_it_does_whole) {
  const Mesh mesh = encode(input(), segmentation());
  for (const auto& field : fields_on(input())) {
    SCOPED_TRACE(field.name);
    expect_the_same_in_parts(find_discrete_gradient(VertexOrder(mesh, field.values.data(), field.values.size())));
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, EdgeChainOf, every_mesh_and_segmentations_in_turn(), mesh_and_segmentation);

TEST(EdgeChain, of_many_edges_falls_in_many_parts) {
  const Mesh mesh(Grid({12, 11, 10}));
  std::mt19937 random(3);
  std::vector<float> values(mesh.vertices());
  for (float& value : values) value = static_cast<float>(random() % 1000);
  EXPECT_GT(expect_the_same_in_parts(find_discrete_gradient(VertexOrder(mesh, values.data(), values.size()))), 20);
}

}  // namespace gale::test
