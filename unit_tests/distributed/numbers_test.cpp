#include <algorithm>
#include <random>
#include <set>

#include <gale/algorithms/simplex_numbers.hpp>
#include <gale/runtime/make_structure.hpp>

#include "distributed/every_partition.hpp"

namespace gale::test {

namespace {

/// All edges, or triangles, of a mesh by their vertices, in lexicographic order.
template <std::size_t N>
std::vector<std::array<Id, N>> simplices_of(const InputMesh& input) {
  std::set<std::array<Id, N>> all;
  for (auto quad : input.tetrahedra) {
    const int size = quad[2] == quad[3] ? 3 : 4;  // triangles have the last corner twice
    std::sort(quad.begin(), quad.begin() + size);
    for (int corners = 0; corners < 1 << size; ++corners) {
      std::array<Id, N> simplex{};
      std::size_t count = 0;
      for (int k = 0; k < size; ++k) {
        if ((corners >> k & 1) == 0) continue;
        if (count < N) simplex[count] = quad[k];
        ++count;
      }
      if (count == N) all.insert(simplex);
    }
  }
  return {all.begin(), all.end()};
}

}  // namespace

class NumbersOnRanks : public EveryPartition {
 protected:
  /// A simplex of input vertices as this rank calls it, in any order.
  template <std::size_t N>
  std::array<Id, N> named(std::array<Id, N> simplex, std::mt19937& random, NamedSimplices& asked) const {
    std::shuffle(simplex.begin(), simplex.end(), random);
    for (Id& vertex : simplex) vertex = called(vertex_name(vertex), asked);
    return simplex;
  }

  Id called(GlobalId name, NamedSimplices& asked) const {
    const Id here = mesh_.vertex_of(name);
    if (here != no_id) return mesh_.vertex_internal()(here);
    asked.beyond.push_back(name);
    return mesh_.vertices() + static_cast<Id>(asked.beyond.size()) - 1;
  }
};

TEST_P(NumbersOnRanks, every_simplex_has_its_place_among_those_of_all_ranks) {
  const auto edges = simplices_of<2>(input());
  const auto triangles = is_surface() ? std::vector<std::array<Id, 3>>() : simplices_of<3>(input());  // cells have ids
  std::mt19937 random(static_cast<unsigned>(ranks_.rank()));
  NamedSimplices asked;
  std::vector<GlobalId> edge_places, triangle_places;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (random() % 3 == 0) continue;
    asked.edges.push_back(named(edges[i], random, asked));
    edge_places.push_back(static_cast<GlobalId>(i));
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (random() % 3 == 0) continue;
    asked.triangles.push_back(named(triangles[i], random, asked));
    triangle_places.push_back(static_cast<GlobalId>(i));
  }
  const auto structure = make_structure(mesh_, simplex_numbers_relations);
  const SimplexNumbers found = number_simplices(*structure, asked);
  EXPECT_EQ(found.edges, edge_places);
  EXPECT_EQ(found.triangles, triangle_places);
}

TEST_P(NumbersOnRanks, simplices_that_are_none_are_refused_on_all_ranks) {
  const auto structure = make_structure(mesh_, simplex_numbers_relations);
  NamedSimplices asked;
  if (ranks_.rank() == 0)  // the second of which is no name
    asked.edges.push_back({called(vertex_name(0), asked), called(vertex_name(0) - 1, asked)});
  EXPECT_THROW(number_simplices(*structure, asked), SharedError);
  if (ranks_.rank() == 0) asked.edges = {{0, mesh_.vertices() + 77}};
  EXPECT_THROW(number_simplices(*structure, asked), SharedError);
}

INSTANTIATE_TEST_SUITE_P(Tests, NumbersOnRanks, every_mesh_and_partition(), mesh_and_partition);

}  // namespace gale::test
