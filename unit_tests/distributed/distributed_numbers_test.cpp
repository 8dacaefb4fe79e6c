#include <algorithm>
#include <random>
#include <set>

#include <gale/distributed/distributed_numbers.hpp>
#include <gale/runtime/make_structure.hpp>

#include "distributed/every_partition.hpp"

namespace gale::test {

namespace {

/// All edges, or triangles, of a mesh by their vertices, in lexicographic order.
template <std::size_t N>
std::vector<std::array<Id, N>> simplices_of(const InputMesh& input) {
  std::set<std::array<Id, N>> all;
  for (auto quad : input.tetrahedra) {
    std::sort(quad.begin(), quad.end());
    for (int corners = 0; corners < 16; ++corners) {
      std::array<Id, N> simplex{};
      std::size_t count = 0;
      for (int k = 0; k < 4; ++k) {
        if ((corners >> k & 1) == 0) continue;
        if (count < N) simplex[count] = quad[k];
        ++count;
      }
      if (count == N) all.insert(simplex);
    }
  }
  return {all.begin(), all.end()};
}

template <std::size_t N>
std::array<GlobalId, N> named(std::array<Id, N> simplex, std::mt19937& random) {
  std::shuffle(simplex.begin(), simplex.end(), random);
  std::array<GlobalId, N> names{};
  for (std::size_t k = 0; k < N; ++k) names[k] = vertex_name(simplex[k]);
  return names;
}

}  // namespace

class NumbersOnRanks : public EveryPartition {};

TEST_P(NumbersOnRanks, every_simplex_has_its_place_among_those_of_all_ranks) {
  const auto edges = simplices_of<2>(input());
  const auto triangles = simplices_of<3>(input());
  std::mt19937 random(static_cast<unsigned>(ranks_.rank()));
  DistributedNamedSimplices asked;
  std::vector<GlobalId> edge_places, triangle_places;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (random() % 3 == 0) continue;
    asked.edges.push_back(named(edges[i], random));
    edge_places.push_back(static_cast<GlobalId>(i));
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (random() % 3 == 0) continue;
    asked.triangles.push_back(named(triangles[i], random));
    triangle_places.push_back(static_cast<GlobalId>(i));
  }
  const auto structure = make_structure(mesh_.local(), simplex_numbers_relations);
  const DistributedNumbers found = number_simplices(*structure, mesh_, asked);
  EXPECT_EQ(found.edges, edge_places);
  EXPECT_EQ(found.triangles, triangle_places);
}

TEST_P(NumbersOnRanks, simplices_that_are_none_are_refused_on_all_ranks) {
  const auto structure = make_structure(mesh_.local(), simplex_numbers_relations);
  DistributedNamedSimplices asked;
  if (ranks_.rank() == 0) asked.edges.push_back({vertex_name(0), vertex_name(0) - 1});  // which is no name
  EXPECT_THROW(number_simplices(*structure, mesh_, asked), SharedError);
}

INSTANTIATE_TEST_SUITE_P(Tests, NumbersOnRanks, every_mesh_and_partition(), mesh_and_partition);

}  // namespace gale::test
