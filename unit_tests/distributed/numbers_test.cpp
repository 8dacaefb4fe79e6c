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

namespace {

/// Calls as many vertices as the input has by the names of these, and one more by a name that is none.
class NamesOfAll final : public Exchange {
 public:
  explicit NamesOfAll(Id vertices) : vertices_(vertices) {}
  GlobalId vertex_id(Id vertex) const override { return vertex < vertices_ ? vertex_name(vertex) : vertex_name(0) - 1; }

 private:
  Id vertices_;
};

/// A mesh without cells that has all the vertices, and so many without a name.
Mesh mesh_of_names(Id vertices, Id nameless = 0) {
  Segmentation one = given_segmentation(Array<std::int64_t, HostMemory>("test", vertices + nameless));
  one.owned_segments = one.segments();
  return {Tetrahedra<Id, HostMemory>(), one, std::make_shared<NamesOfAll>(vertices)};
}

}  // namespace

class NumbersOnRanks : public EveryPartition {
 protected:
  /// A simplex of input vertices, in any order.
  template <std::size_t N>
  static std::array<Id, N> named(std::array<Id, N> simplex, std::mt19937& random) {
    std::shuffle(simplex.begin(), simplex.end(), random);
    return simplex;
  }
};

TEST_P(NumbersOnRanks, every_simplex_has_its_place_among_those_of_all_ranks) {
  const auto edges = simplices_of<2>(input());
  const auto triangles = is_surface() ? std::vector<std::array<Id, 3>>() : simplices_of<3>(input());  // cells have ids
  std::mt19937 random(static_cast<unsigned>(ranks_.rank()));
  NamedSimplices asked;
  asked.excerpt = mesh_of_names(input().vertices());
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
  const auto structure = make_structure(mesh_, simplex_numbers_relations);
  const SimplexNumbers found = number_simplices(*structure, asked);
  EXPECT_EQ(found.edges, edge_places);
  EXPECT_EQ(found.triangles, triangle_places);
  const auto whole = make_structure(whole_mesh(), simplex_numbers_relations);
  const auto on_surface = number_simplices(*whole, NamedSimplices()).on_surface;
  for (Id v = 0; v < whole->mesh().vertices(); ++v)
    EXPECT_EQ(found.on_surface(whole->mesh().vertex_input()(v)), on_surface(v));
}

TEST_P(NumbersOnRanks, simplices_that_are_none_are_refused_on_all_ranks) {
  const auto structure = make_structure(mesh_, simplex_numbers_relations);
  NamedSimplices asked;
  asked.excerpt = mesh_of_names(input().vertices(), 1);
  if (ranks_.rank() == 0) asked.edges = {{0, input().vertices()}};  // the second of which is no name
  EXPECT_THROW(number_simplices(*structure, asked), SharedError);
  if (ranks_.rank() == 0) asked.edges = {{0, input().vertices() + 77}};
  EXPECT_THROW(number_simplices(*structure, asked), SharedError);
}

INSTANTIATE_TEST_SUITE_P(Tests, NumbersOnRanks, every_mesh_and_partition(), mesh_and_partition);

}  // namespace gale::test
