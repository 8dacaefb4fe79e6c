#include <gale/algorithms/critical_points.hpp>
#include <gale/algorithms/excerpt/whole_mesh.hpp>
#include <gale/algorithms/gathered_gradient.hpp>
#include <gale/algorithms/merge_tree.hpp>
#include <gale/algorithms/persistence.hpp>
#include <gale/algorithms/simplify.hpp>
#include <gale/algorithms/simplify_field.hpp>
#include <gale/base/error.hpp>

#include "algorithms/fields.hpp"
#include "distributed/every_partition.hpp"
#include "support/arrays.hpp"

namespace gale::test {

/// What is gathered of a mesh on several ranks, compared with the whole mesh on one.
class GatheredOnRanks : public EveryPartition {
 protected:
  const Mesh whole_ = whole_mesh();

  /// Few values, so that ties matter, and a permutation.
  std::vector<Field> fields() const { return fields_of_turn(0, 4); }

  static VertexOrder order_of(const Mesh& mesh, const std::vector<double>& values) {
    return VertexOrder(mesh, values.data(), values.size());
  }

  /// The input's vertex that a mesh calls so (GALE's id): the whole, or one that has the global ids.
  static Id input_of(const Mesh& mesh, Id vertex) {
    const Id input = mesh.vertex_input()(vertex);
    return mesh.is_part() ? vertex_named(mesh.vertex_id(input)) : input;
  }
  static Id input_cell_of(const Mesh& mesh, Id cell) {
    const Id input = mesh.cell_input()(cell);
    return mesh.is_part() ? cell_named(mesh.cell_id(input)) : input;
  }

  /// The input's vertices and cells on separatrices, and where these begin, end, and follow one another.
  template <class Cell, class NameOf>
  static std::vector<std::vector<Id>> names_of(const Separatrices<Cell>& some, const NameOf& name_of) {
    std::vector<std::vector<Id>> names = {some.sources, some.destinations, {some.joins.begin(), some.joins.end()}, {}};
    for (const Offset begin : some.begin) names.back().push_back(static_cast<Id>(begin));
    for (const Cell& cell : some.cells) names.push_back(name_of(cell));
    return names;
  }

  template <std::size_t N>
  static std::vector<std::vector<Id>> names_of(const Mesh& mesh, const std::vector<std::array<Id, N>>& simplices) {
    std::vector<std::vector<Id>> names;
    for (const auto& simplex : simplices) {
      names.emplace_back();
      for (const Id v : simplex) names.back().push_back(input_of(mesh, v));
    }
    return names;
  }
  static std::vector<Id> names_of(const Mesh& mesh, const std::vector<Id>& vertices) {
    std::vector<Id> names;
    for (const Id v : vertices) names.push_back(input_of(mesh, v));
    return names;
  }

  static void expect_complex(const MorseSmaleComplex& found, const MorseSmaleComplex& expected) {
    const Mesh &here = found.excerpt.mesh(), &there = expected.excerpt.mesh();
    EXPECT_EQ(found.critical.counts(), expected.critical.counts());
    EXPECT_EQ(names_of(here, found.critical.vertices), names_of(there, expected.critical.vertices));
    EXPECT_EQ(names_of(here, found.critical.edges), names_of(there, expected.critical.edges));
    EXPECT_EQ(names_of(here, found.critical.triangles), names_of(there, expected.critical.triangles));
    const auto vertex_of = [](const Mesh& mesh) { return [&](Id v) { return std::vector<Id>{input_of(mesh, v)}; }; };
    const auto cell_of = [](const Mesh& mesh) { return [&](Id t) { return std::vector<Id>{input_cell_of(mesh, t)}; }; };
    const auto triangle_of = [](const Mesh& mesh) {
      return
          [&](const TriangleVertices& triangle) { return names_of(mesh, std::vector<TriangleVertices>{triangle})[0]; };
    };
    EXPECT_EQ(names_of(found.descending, vertex_of(here)), names_of(expected.descending, vertex_of(there)));
    EXPECT_EQ(names_of(found.ascending, cell_of(here)), names_of(expected.ascending, cell_of(there)));
    EXPECT_EQ(names_of(found.connectors, triangle_of(here)), names_of(expected.connectors, triangle_of(there)));
    EXPECT_EQ(found.connectors.is_only, expected.connectors.is_only);
  }

  /// Has each local vertex the number that it has in the whole mesh?
  void expect_numbers(const std::vector<Id>& found, const std::vector<Id>& expected) const {
    ASSERT_EQ(found.size(), mesh_.vertex_ids().extent(0));
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_EQ(found[i], expected[vertex_named(mesh_.vertex_ids()(i))])
          << "vertex " << vertex_named(mesh_.vertex_ids()(i));
  }
};

TEST_P(GatheredOnRanks, pairs_are_those_of_one_rank) {
  for (const Field& field : fields()) {
    SCOPED_TRACE(field.name);
    const auto& [expected, highest] = once(field.name, [&] {
      const DiscreteGradient gradient = find_discrete_gradient(order_of(whole_, field.values));
      return std::make_pair(find_persistence_pairs(gradient), highest_vertices(gradient));
    });
    const GatheredPairs found = gather_persistence_pairs(find_discrete_gradient(order_here(field)));
    if (ranks_.rank() != 0) {
      EXPECT_EQ(found.highest.of_critical, decltype(found.highest.of_critical)());
      continue;
    }
    EXPECT_EQ(found.pairs.pairs, expected.pairs);
    EXPECT_EQ(found.pairs.essential, expected.essential);
    const auto input_of_all = [&](const std::vector<Id>& vertices) {
      std::vector<Id> input;
      for (const Id v : vertices)
        input.push_back(ranks_.size() == 1 ? vertex_named(mesh_.vertex_id(v)) : vertex_named(found.mesh.vertex_id(v)));
      return input;
    };
    for (int d = 0; d < 4; ++d) EXPECT_EQ(input_of_all(found.highest.of_critical[d]), highest.of_critical[d]);
    EXPECT_EQ(input_of_all({found.highest.of_all}), std::vector<Id>{highest.of_all});
  }
}

TEST_P(GatheredOnRanks, simplified_complexes_are_those_of_one_rank) {
  for (const Field& field : fields()) {
    SCOPED_TRACE(field.name);
    const double threshold = field.name == "permutation" ? 0.1 * input().vertices() : 4;
    const auto& expected = once(field.name, [&] {
      return simplify(
          find_morse_smale_complex(find_discrete_gradient(order_of(whole_, field.values))),
          [&](Id v) { return field.values[v]; }, threshold);
    });
    MorseSmaleParts manifolds;  // the rest is found again where it is gathered
    manifolds.descending_separatrices = manifolds.ascending_separatrices = manifolds.saddle_connectors = false;
    auto complex = find_morse_smale_complex(find_discrete_gradient(order_here(field)),
                                            ranks_.size() == 1 ? MorseSmaleParts() : manifolds);
    complex.parts = {};
    const auto found = simplify(
        complex, [&](Id v) { return field.values[vertex_named(mesh_.vertex_ids()(v))]; }, threshold);
    if (ranks_.rank() == 0) expect_complex(found, expected);
    expect_numbers(to_vector(found.descending_manifold), to_vector(expected.descending_manifold));
    expect_numbers(to_vector(found.ascending_manifold), to_vector(expected.ascending_manifold));
    expect_numbers(to_vector(found.morse_smale_manifold), to_vector(expected.morse_smale_manifold));
    EXPECT_EQ(found.kept_below.count(), expected.kept_below.count());
  }
}

TEST_P(GatheredOnRanks, trees_are_those_of_one_rank) {
  for (const Field& field : fields()) {
    SCOPED_TRACE(field.name);
    const auto& expected = once(field.name, [&] { return find_merge_trees(order_of(whole_, field.values)); });
    const auto found = find_merge_trees(order_here(field));
    for (int tree = 0; tree < 3; ++tree) {
      SCOPED_TRACE(tree);
      std::vector<Id> vertices;
      for (const Id v : found[tree].vertices)
        vertices.push_back(ranks_.size() == 1 ? vertex_named(mesh_.vertex_id(v))
                                              : vertex_named(found[tree].excerpt->vertex_id(v)));
      EXPECT_EQ(vertices, expected[tree].vertices);
      EXPECT_EQ(found[tree].types, expected[tree].types);
      EXPECT_EQ(found[tree].arcs, expected[tree].arcs);
      expect_numbers(found[tree].arc_of, expected[tree].arc_of);
    }
  }
}

TEST_P(GatheredOnRanks, trees_without_branches_are_those_of_one_rank) {
  const Field field = fields_on(input())[4];
  MergeTreeOptions whole, here;
  whole.threshold = here.threshold = 0.2 * input().vertices();
  whole.value = [&](Id v) { return field.values[v]; };
  here.value = [&](Id v) { return field.values[vertex_named(mesh_.vertex_ids()(v))]; };
  for (const Tree tree : {Tree::join, Tree::split, Tree::contour}) {
    const auto expected = find_merge_tree(order_of(whole_, field.values), tree, whole);
    const auto found = find_merge_tree(order_here(field), tree, here);
    EXPECT_EQ(found.types, expected.types);
    EXPECT_EQ(found.arcs, expected.arcs);
    expect_numbers(found.arc_of, expected.arc_of);
  }
}

TEST_P(GatheredOnRanks, simplified_fields_are_those_of_one_rank) {
  for (const Field& field : fields()) {
    SCOPED_TRACE(field.name);
    const auto expect = [&](const SimplifiedField& found, const SimplifiedField& expected) {
      expect_numbers(found.rank, expected.rank);
      std::vector<Id> value_of;
      for (const Id v : found.value_of)
        value_of.push_back(vertex_named(found.excerpt ? found.excerpt->vertex_id(v) : mesh_.vertex_id(v)));
      expect_numbers(value_of, expected.value_of);
      EXPECT_EQ(std::make_tuple(found.minima, found.maxima, found.kept_below),
                std::make_tuple(expected.minima, expected.maxima, expected.kept_below));
    };
    const VertexOrder order = order_here(field), whole_order = order_of(whole_, field.values);
    const double threshold = field.name == "permutation" ? 0.3 * input().vertices() : 3;
    const auto value_here = [&](Id v) { return field.values[vertex_named(mesh_.vertex_ids()(v))]; };
    const auto& expected = once(field.name, [&] {
      return simplify_field(
          whole_order, [&](Id v) { return field.values[v]; }, threshold);
    });
    expect(simplify_field(order, value_here, threshold), expected);
    // By what is left of it, of which each rank names its own.
    const auto left = find_critical_points(VertexOrder::of_places(whole_, expected.rank));
    const auto extrema = find_critical_points(whole_order);
    if (left.counts[4] > 0 || expected.kept_below > 0) continue;
    StayingExtrema staying, staying_here;
    for (std::size_t i = 0; i < left.vertices.size(); ++i) {
      const bool is_minimum = left.types[i] == CriticalType::minimum;
      if (!is_minimum && left.types[i] != CriticalType::maximum) continue;
      const auto at = std::find(extrema.vertices.begin(), extrema.vertices.end(), left.vertices[i]);
      if (at == extrema.vertices.end() || extrema.types[at - extrema.vertices.begin()] != left.types[i]) continue;
      (is_minimum ? staying.minima : staying.maxima).push_back(left.vertices[i]);
    }
    for (const Id v : mesh_.owned_vertices()) {
      const Id here = mesh_.vertex_input()(v), named = vertex_named(mesh_.vertex_id(here));
      for (const bool is_minimum : {true, false}) {
        const auto& all = is_minimum ? staying.minima : staying.maxima;
        if (std::find(all.begin(), all.end(), named) != all.end())
          (is_minimum ? staying_here.minima : staying_here.maxima).push_back(here);
      }
    }
    expect(simplify_field(order, staying_here), simplify_field(whole_order, staying));
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, GatheredOnRanks, every_mesh_and_partition(), mesh_and_partition);

TEST(GatheredGradient, a_rank_without_room_says_so_on_all) {
  const Communicator ranks(MPI_COMM_WORLD);
  if (ranks.size() == 1) return;  // nothing is gathered
  const InputMesh& input = mesh_named("slivers");
  const GivenPart part = part_of(input, "random", ranks);
  const DistributedMesh mesh = distribute(ranks, part, "random");
  const auto gradient = find_discrete_gradient(VertexOrder(mesh, part.values(fields_on(input)[4].values)));
  try {
    gather_gradient(gradient, 10);
    ADD_FAILURE() << "it had room";
  } catch (const SharedError& error) {
    EXPECT_NE(std::string(error.what()).find("there is room for 10"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("rank 0"), std::string::npos) << error.what();
  }
  EXPECT_GT(gather_gradient(gradient).mesh().vertices() + ranks.rank(), 0);
  EXPECT_THROW(detail::WholeMesh(gradient.order(), "all of it", 10), SharedError);
}

}  // namespace gale::test
