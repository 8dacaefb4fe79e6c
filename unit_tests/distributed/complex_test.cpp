#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/morse_smale/paths_on_ranks.hpp>
#include <gale/runtime/make_structure.hpp>

#include "algorithms/fields.hpp"
#include "distributed/every_partition.hpp"
#include "support/arrays.hpp"
#include "support/with_threads.hpp"

namespace gale::test {

class ComplexOnRanks : public EveryPartition {
 protected:
  /// The complex of the whole mesh, on this rank alone.
  MorseSmaleComplex complex_on_one(const std::vector<double>& values) const {
    const Mesh whole = whole_mesh();
    const auto structure = make_structure(whole, discrete_gradient_relations_of(whole.dimension()));
    return find_morse_smale_complex(
        *structure, find_discrete_gradient(*structure, VertexOrder(whole, values.data(), values.size())));
  }

  MorseSmaleComplex complex_of(const std::vector<double>& values) const {
    const VertexOrder order(mesh_, part_.values(values));
    const auto structure = make_structure(mesh_, discrete_gradient_relations_of(mesh_.dimension()));
    MorseSmaleParts parts;
    parts.saddle_connectors = is_surface();  // which has none
    return find_morse_smale_complex(*structure, find_discrete_gradient(*structure, order), parts);
  }

  /// Has each local vertex the number that it has in the whole mesh?
  void expect_numbers(const Mirrored<Id>& found, const std::vector<Id>& expected) const {
    ASSERT_EQ(found.size(), mesh_.vertex_ids().extent(0));
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Id v = vertex_named(mesh_.vertex_ids()(i));
      EXPECT_EQ(found.in<HostMemory>()(i), expected[v]) << "vertex " << v;
    }
  }

  /// The input's number of a vertex, or a cell, on a path.
  Id vertex_on_path(const MorseSmaleComplex& found, Id vertex) const {
    const Id n = mesh_.vertices();
    return vertex < n ? input_vertex(vertex) : vertex_named(found.beyond.vertices[vertex - n]);
  }
  Id cell_on_path(const MorseSmaleComplex& found, Id cell) const {
    const Id n = mesh_.cells();
    return cell < n ? input_cell(cell) : cell_named(found.beyond.cells[cell - n]);
  }

  /// A path: the input's numbers of its source's vertices, where it ends, and those of the simplices on it.
  using Path = std::tuple<std::vector<Id>, Id, std::vector<Id>>;
  using Paths = std::map<Path, std::int64_t>;

  template <class Source, class VertexOf, class CellOf>
  static Paths paths_of(const Separatrices<Id>& some, const std::vector<Source>& sources, const VertexOf& vertex_of,
                        const CellOf& cell_of) {
    Paths paths;
    for (Id i = 0; i < some.count(); ++i) {
      std::vector<Id> source, cells;
      for (const Id v : sources[some.sources[i]]) source.push_back(vertex_of(v));
      for (const Id* cell = some.first(i); cell != some.last(i); ++cell) cells.push_back(cell_of(*cell));
      ++paths[{source, some.destinations[i], cells}];
    }
    return paths;
  }

  /// The sum over all ranks of how often each of the paths is there must be how often it is in the whole mesh.
  void expect_paths(const Paths& here, const Paths& expected) const;
};

TEST_P(ComplexOnRanks, manifolds_are_those_of_one_rank) {
  for (const Field& field : {fields_on(input())[0], fields_on(input())[2]}) {
    SCOPED_TRACE(field.name);
    const MorseSmaleComplex whole = complex_on_one(field.values);
    const MorseSmaleComplex found = complex_of(field.values);
    expect_numbers(found.descending_manifold, to_vector(whole.descending_manifold));
    expect_numbers(found.ascending_manifold, to_vector(whole.ascending_manifold));
    expect_numbers(found.morse_smale_manifold, to_vector(whole.morse_smale_manifold));
    EXPECT_EQ(found.morse_smale_manifolds, whole.morse_smale_manifolds);
  }
}

void ComplexOnRanks::expect_paths(const Paths& here, const Paths& expected) const {
  for (const auto& [path, times] : here) EXPECT_EQ(expected.count(path), 1u) << "to " << std::get<1>(path);
  std::vector<std::int64_t> counts;
  for (const auto& [path, times] : expected) counts.push_back(here.count(path) == 0 ? 0 : here.at(path));
  ranks_.sum(counts.data(), static_cast<int>(counts.size()));
  std::size_t at = 0;
  for (const auto& [path, times] : expected) EXPECT_EQ(counts[at++], times) << "to " << std::get<1>(path);
}

TEST_P(ComplexOnRanks, separatrices_are_those_of_one_rank) {
  for (const Field& field : {fields_on(input())[0], fields_on(input())[4]}) {
    SCOPED_TRACE(field.name);
    const MorseSmaleComplex whole = complex_on_one(field.values), found = complex_of(field.values);
    const auto& vertex_input = whole.gradient.mesh().vertex_input();
    const auto& cell_input = whole.gradient.mesh().cell_input();
    const auto vertex_here = [&](Id v) { return vertex_on_path(found, v); };
    const auto cell_here = [&](Id t) { return cell_on_path(found, t); };
    expect_paths(paths_of(found.descending, found.critical.edges, vertex_here, vertex_here),
                 paths_of(whole.descending, whole.critical.edges, vertex_input, vertex_input));
    const auto expect_ascending = [&](const auto& saddles, const auto& saddles_of_whole) {
      expect_paths(paths_of(found.ascending, saddles, vertex_here, cell_here),
                   paths_of(whole.ascending, saddles_of_whole, vertex_input, cell_input));
    };
    is_surface() ? expect_ascending(found.critical.edges, whole.critical.edges)
                 : expect_ascending(found.critical.triangles, whole.critical.triangles);
  }
}

TEST_P(ComplexOnRanks, simplices_beyond_a_part_are_those_that_it_does_not_hold) {
  const MorseSmaleComplex found = complex_of(fields_on(input())[0].values);
  std::set<GlobalId> names;
  for (const GlobalId name : found.beyond.vertices) {
    EXPECT_EQ(mesh_.vertex_of(name), no_id);
    EXPECT_TRUE(names.insert(name).second);
  }
  ASSERT_EQ(found.beyond.corners.size(), found.beyond.cells.size());
  for (std::size_t i = 0; i < found.beyond.cells.size(); ++i) {
    EXPECT_EQ(mesh_.exchange().cell_of(found.beyond.cells[i]), no_id);
    std::set<Id> corners;
    for (const Id v : found.beyond.corners[i]) corners.insert(vertex_on_path(found, v));
    const auto& quad = input().tetrahedra[cell_named(found.beyond.cells[i])];
    EXPECT_EQ(corners, std::set<Id>(quad.begin(), quad.end()));
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, ComplexOnRanks, every_mesh_and_partition(), mesh_and_partition);

TEST(PathsOnRanks, take_few_rounds_to_their_ends) {
  const Communicator ranks(MPI_COMM_WORLD);
  const InputMesh& input = mesh_named("slivers");  // a strip of 60 vertices
  const GivenPart part = part_of(input, "random", ranks);
  const DistributedMesh mesh = distribute(ranks, part, "random");
  std::vector<int> values(input.vertices());
  for (Id v = 0; v < input.vertices(); ++v) values[v] = v;
  const auto structure = make_structure(mesh, discrete_gradient_relations);
  const auto gradient = find_discrete_gradient(*structure, VertexOrder(mesh, part.values(values)));
  const detail::PathSimplices vertices(gradient, detail::PathSimplices::Kind::falling_vertices);
  const detail::PathsOnRanks paths(vertices);
  EXPECT_LE(paths.rounds(), 6);  // 2^6 steps are more than any path has
  if (ranks.size() == 1) EXPECT_EQ(paths.rounds(), 0);
  for (Id v = 0; v < mesh.owned_vertices(); ++v) {
    const detail::PathStop stop = paths.final_stop(paths.end(v));
    EXPECT_EQ(stop.rank, detail::PathStop::critical);
    EXPECT_EQ(stop.id, vertex_name(0));
  }
}

}  // namespace gale::test
