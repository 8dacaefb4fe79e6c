#include <algorithm>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <gale/algorithms/excerpt/edge_fall.hpp>
#include <gale/base/threads.hpp>
#include <gale/runtime/make_structure.hpp>

#include "algorithms/fields.hpp"
#include "support/every_mesh.hpp"
#include "support/full_device.hpp"

namespace gale::test {

namespace {

using Edge = std::array<Id, 2>;
using Passed = std::vector<std::array<Id, 3>>;

Edge from_higher(const DiscreteGradient& gradient, Id a, Id b) {
  const std::uint64_t* const keys = gradient.order().keys();
  return keys[a] > keys[b] ? Edge{a, b} : Edge{b, a};
}

/// Follows edges one by one, by what a gradient says of each edge.
Passed passed_from(const DiscreteGradient& gradient, const std::vector<Edge>& starts) {
  std::set<Edge> known(starts.begin(), starts.end());
  std::vector<Edge> open(known.begin(), known.end());
  Passed passed;
  while (!open.empty()) {
    const auto [high, low] = open.back();
    open.pop_back();
    const Partner partner = gradient.pair_of_edge(high, low);
    if (partner.dimension == 0) continue;
    passed.push_back({high, low, partner.dimension == 2 ? partner.vertex : detail::edge_is_critical});
    if (partner.dimension != 2) continue;
    for (const Id end : {high, low}) {
      const Edge next = from_higher(gradient, end, partner.vertex);
      if (known.insert(next).second) open.push_back(next);
    }
  }
  std::sort(passed.begin(), passed.end());
  return passed;
}

/// The edges of critical triangles.
std::vector<Edge> rims(const DiscreteGradient& gradient) {
  std::vector<Edge> edges;
  for (const auto& [a, b, c] : gradient.critical().triangles) edges.insert(edges.end(), {{a, b}, {a, c}, {b, c}});
  return edges;
}

}  // namespace

TEST(EdgeFall, passes_each_edge_that_falls_once_however_often_it_is_asked) {
  const InputMesh input = holed_grid(14);
  const Mesh mesh = encode(input, 100);
  const auto structure = make_structure(mesh, discrete_gradient_relations_of(3));
  for (const Field& field : fields_on(input)) {
    SCOPED_TRACE(field.name);
    const VertexOrder order(mesh, field.values.data(), field.values.size());
    const DiscreteGradient by_consumers = find_discrete_gradient(*structure, order);
    const auto starts = rims(by_consumers);
    const Passed expected = passed_from(by_consumers, starts);
    const DiscreteGradient by_kernels = find_discrete_gradient(WorkerSpace(), order);
    ASSERT_TRUE(by_kernels.store().is_from_kernels());
    for (const DiscreteGradient& gradient : {by_consumers, by_kernels}) {
      const ThreadLimit limit(3);
      detail::EdgeFall fall(gradient);
      const auto half = starts.begin() + static_cast<std::ptrdiff_t>(starts.size() / 2);
      EXPECT_TRUE(fall.fall({}).empty());
      EXPECT_TRUE(fall.fall({starts.begin(), half}).empty()) << "what lies in a whole mesh is nobody else's";
      EXPECT_TRUE(fall.fall(starts).empty());
      Passed passed = fall.passed();
      std::sort(passed.begin(), passed.end());
      EXPECT_EQ(passed, expected);
    }
  }
}

TEST(EdgeFall, begins_anew_on_the_host_when_the_device_is_full) {
  if (!have_device) return;
  const InputMesh input = holed_grid(30);
  const Mesh mesh = encode(input, 100);
  const auto field = random_field(input, 1);
  const VertexOrder order(mesh, field.data(), field.size());
  const DiscreteGradient gradient = find_discrete_gradient(WorkerSpace(), order);
  ASSERT_TRUE(gradient.store().is_from_kernels());
  const auto starts = rims(gradient);
  detail::EdgeFall fall(gradient);
  fall.fall({starts.begin(), starts.begin() + 1});
  const FullDevice full(0);
  EXPECT_TRUE(fall.fall(starts).empty());
  Passed passed = fall.passed();
  std::sort(passed.begin(), passed.end());
  EXPECT_EQ(passed, passed_from(gradient, starts));
}

}  // namespace gale::test
