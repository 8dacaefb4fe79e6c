#include <algorithm>
#include <map>
#include <numeric>
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
  MorseSmaleComplex complex_on_one(const std::vector<double>& values, const MorseSmaleParts& parts = {}) const {
    const Mesh whole = whole_mesh();
    const auto structure = make_structure(whole, discrete_gradient_relations_of(whole.dimension()));
    return find_morse_smale_complex(
        *structure, find_discrete_gradient(*structure, VertexOrder(whole, values.data(), values.size())), parts);
  }

  MorseSmaleComplex complex_of(const VertexOrder& order, const MorseSmaleParts& parts = {}) const {
    const auto structure = make_structure(mesh_, discrete_gradient_relations_of(mesh_.dimension()));
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

  /// The input's number of a vertex, or a cell, that a complex names.
  static Id vertex_on_path(const MorseSmaleComplex& found, Id vertex) {
    const Mesh& mesh = found.excerpt.mesh();
    const Id input = mesh.vertex_input()(vertex);
    return mesh.is_part() ? vertex_named(mesh.vertex_id(input)) : input;
  }
  static Id cell_on_path(const MorseSmaleComplex& found, Id cell) {
    const Mesh& mesh = found.excerpt.mesh();
    const Id input = mesh.cell_input()(cell);
    return mesh.is_part() ? cell_named(mesh.cell_id(input)) : input;
  }

  /// Names all vertices of a simplex, in its order.
  template <std::size_t N>
  static std::vector<Id> names_of(const MorseSmaleComplex& found, const std::array<Id, N>& simplex) {
    std::vector<Id> names;
    for (const Id v : simplex) names.push_back(vertex_on_path(found, v));
    return names;
  }
  static std::vector<Id> names_of(const MorseSmaleComplex& found, Id vertex) { return {vertex_on_path(found, vertex)}; }

  /// A path, or a surface: the vertices of its source, of where it ends, and what it leads through.
  using Path = std::tuple<std::vector<Id>, std::vector<Id>, std::vector<std::vector<Id>>>;
  using Paths = std::map<Path, std::int64_t>;

  template <class Cell, class Sources, class Ends, class NamesOfCell>
  static Paths paths_of(const MorseSmaleComplex& found, const Separatrices<Cell>& some, const Sources& sources,
                        const Ends& ends, const NamesOfCell& names_of_cell) {
    Paths paths;
    for (Id i = 0; i < some.count(); ++i) {
      Path path{names_of(found, sources[some.sources[i]]), {}, {}};
      if (!some.destinations.empty()) std::get<1>(path) = ends(some.destinations[i]);
      for (Offset k = some.begin[i]; k < some.begin[i + 1]; ++k) std::get<2>(path).push_back(names_of_cell(k));
      ++paths[path];
    }
    return paths;
  }

  /// All that a complex leads through, by kind: descending and ascending paths, connectors, walls.
  static std::array<Paths, 5> all_paths_of(const MorseSmaleComplex& found) {
    const auto& critical = found.critical;
    const auto vertex = [&](Id place) { return names_of(found, critical.vertices[place]); };
    const auto cell = [&](Id place) { return std::vector<Id>{cell_on_path(found, critical.cells[place])}; };
    const auto triangle = [&](Id place) { return names_of(found, critical.triangles[place]); };
    const auto nothing = [](Id) { return std::vector<Id>(); };
    std::array<Paths, 5> all;
    all[0] = paths_of(found, found.descending, critical.edges, vertex,
                      [&](Offset k) { return names_of(found, found.descending.cells[k]); });
    const auto rising = [&](const auto& saddles) {
      return paths_of(found, found.ascending, saddles, cell,
                      [&](Offset k) { return std::vector<Id>{cell_on_path(found, found.ascending.cells[k])}; });
    };
    all[1] = critical.dimension == 2 ? rising(critical.edges) : rising(critical.triangles);
    all[2] = paths_of(found, found.connectors, critical.edges, triangle,
                      [&](Offset k) { return names_of(found, found.connectors.cells[k]); });
    all[3] = paths_of(found, found.descending_walls, critical.triangles, nothing,
                      [&](Offset k) { return names_of(found, found.descending_walls.cells[k]); });
    const auto& walls = found.ascending_walls;
    all[4] = paths_of(found, walls.walls, critical.edges, nothing, [&](Offset k) {
      auto names = names_of(found, walls.walls.cells[k]);
      for (Offset t = walls.star_begin[k]; t < walls.star_begin[k + 1]; ++t)
        names.push_back(cell_on_path(found, walls.star[t]));
      return names;
    });
    return all;
  }

  /// The sum over all ranks of how often each of the paths is there must be how often it is in the whole mesh.
  void expect_paths(const Paths& here, const Paths& expected) const;
};

TEST_P(ComplexOnRanks, manifolds_are_those_of_one_rank) {
  for (const Field& field : fields_of_turn(0, 2)) {
    SCOPED_TRACE(field.name);
    const MorseSmaleComplex& whole = once(field.name, [&] { return complex_on_one(field.values); });
    const MorseSmaleComplex found = complex_of(order_here(field));
    expect_numbers(found.descending_manifold, to_vector(whole.descending_manifold));
    expect_numbers(found.ascending_manifold, to_vector(whole.ascending_manifold));
    expect_numbers(found.morse_smale_manifold, to_vector(whole.morse_smale_manifold));
    EXPECT_EQ(found.morse_smale_manifolds, whole.morse_smale_manifolds);
  }
}

void ComplexOnRanks::expect_paths(const Paths& here, const Paths& expected) const {
  for (const auto& [path, times] : here)
    EXPECT_EQ(expected.count(path), 1u) << "from " << testing::PrintToString(std::get<0>(path));
  std::vector<std::int64_t> counts;
  for (const auto& [path, times] : expected) counts.push_back(here.count(path) == 0 ? 0 : here.at(path));
  ranks_.sum(counts.data(), static_cast<int>(counts.size()));
  std::size_t at = 0;
  for (const auto& [path, times] : expected)
    EXPECT_EQ(counts[at++], times) << "from " << testing::PrintToString(std::get<0>(path));
}

TEST_P(ComplexOnRanks, separatrices_are_those_of_one_rank) {
  for (const Field& field : fields_of_turn(0, 4)) {
    SCOPED_TRACE(field.name);
    MorseSmaleParts parts;
    parts.separatrices2 = !is_surface() && field.name == "permutation";
    const auto& expected = once(field.name, [&] { return all_paths_of(complex_on_one(field.values, parts)); });
    const VertexOrder order = order_here(field);
    const auto found = all_paths_of(complex_of(order, parts));
    for (std::size_t kind = 0; kind < expected.size(); ++kind) {
      SCOPED_TRACE(kind);
      expect_paths(found[kind], expected[kind]);
    }
    for (const bool with_manifolds : {true, false}) {  // which find where paths leave a part, too
      SCOPED_TRACE(with_manifolds);
      MorseSmaleParts paths;
      paths.descending_manifolds = paths.ascending_manifolds = with_manifolds;
      const auto on_host = with_manifolds ? found : all_paths_of(complex_of(order, paths));
      const auto by_kernels =
          is_surface() ? on_host
                       : all_paths_of(find_morse_smale_complex(find_discrete_gradient(WorkerSpace(), order), paths));
      for (std::size_t kind = 0; kind < 3; ++kind) {
        SCOPED_TRACE(kind);
        expect_paths(on_host[kind], expected[kind]);
        expect_paths(by_kernels[kind], expected[kind]);
      }
    }
  }
}

TEST_P(ComplexOnRanks, critical_simplices_are_those_of_the_gradient_and_those_that_separatrices_reach) {
  const MorseSmaleComplex found = complex_of(VertexOrder(mesh_, part_.values(fields_on(input())[0].values)));
  const auto own = found.own_counts(), all = found.gradient.critical().counts();
  EXPECT_EQ(own, all);
  for (std::size_t i = 0; i < found.critical.vertices.size(); ++i)
    EXPECT_EQ(found.owns(0, static_cast<Id>(i)), owned()[vertex_on_path(found, found.critical.vertices[i])]);
  const DiscreteGradient& excerpt = found.excerpt;
  for (const Id vertex : found.critical.vertices) EXPECT_TRUE(excerpt.pair_of_vertex(vertex).is_critical());
  for (const auto& [high, low] : found.critical.edges) EXPECT_TRUE(excerpt.pair_of_edge(high, low).is_critical());
  for (const Id one : found.critical.cells) EXPECT_TRUE(excerpt.pair_of_cell(one).is_critical());
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
  for (const auto kind : {detail::PathSimplices::Kind::falling_vertices, detail::PathSimplices::Kind::rising_cells}) {
    const detail::PathSimplices simplices(gradient, kind);
    std::vector<Id> all(simplices.successors().size());
    std::iota(all.begin(), all.end(), Id(0));
    const std::vector<int> owners = simplices.owners(all);
    const std::uint64_t* const keys = gradient.order().keys();
    for (const Id one : all) {
      Id highest = one;
      if (!simplices.are_vertices()) {
        const Quad corners = mesh.cell_reader()(one);
        highest = corners.a;
        for (const Id v : {corners.b, corners.c, corners.d}) highest = keys[v] > keys[highest] ? v : highest;
      }
      EXPECT_EQ(owners[one], mesh.exchange().owner(mesh.vertices_in_input()[highest]));
    }
  }
  std::vector<GlobalId> minima;
  for (const Id vertex : vertices.critical()) minima.push_back(vertices.global(vertex));
  std::vector<Id> own;
  for (const Id v : mesh.owned_vertices()) own.push_back(v);
  const Array<const GlobalId, HostMemory> names(minima.data(), minima.size());
  for (const Offset most_told : {0, 1'000}) {
    const detail::PathsOnRanks paths(vertices, names, {}, most_told);
    EXPECT_LE(paths.rounds(), most_told == 0 ? 7 : 3);  // 2^6 changes of ranks are more than any path has
    if (ranks.size() == 1) EXPECT_EQ(paths.rounds(), 0);
    for (const Id end : paths.ends_of(own)) EXPECT_EQ(paths.final_name(end), vertex_name(0));
  }
}

}  // namespace gale::test
