#include <algorithm>
#include <map>
#include <tuple>

#include <gale/algorithms/critical_points.hpp>
#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/runtime/make_structure.hpp>

#include "algorithms/brute_force_types.hpp"
#include "algorithms/fields.hpp"
#include "algorithms/structure_kinds.hpp"
#include "distributed/every_partition.hpp"

namespace gale::test {

class OnRanks : public EveryPartition {
 protected:
  /// Others with each partition, so that each mesh has all on two ranks.
  std::vector<Field> fields() const {
    const std::size_t all = fields_on(input()).size();
    const auto& names = partition_names();
    const std::size_t at = std::find(names.begin(), names.end(), partition()) - names.begin();
    return fields_of_turn(static_cast<int>(at % all), static_cast<int>((at + 1) % all));
  }

  /// What each vertex is, and whether it is on the surface.
  struct Types {
    std::vector<int> types;
    std::vector<std::uint8_t> on_surface;
  };

  /// By brute force; of triangles as one rank finds them, which other tests compare with brute force.
  Types expected_types(const Field& field) const {
    if (!is_surface()) {
      const BruteForce& brute_force = brute_force_of(mesh_name());
      return {brute_force_types(input(), brute_force, field.values), brute_force.on_surface};
    }
    Types expected{std::vector<int>(input().vertices(), 5), std::vector<std::uint8_t>(input().vertices())};
    const auto found = find_critical_points(VertexOrder(whole_mesh(), field.values.data(), field.values.size()));
    for (std::size_t i = 0; i < found.vertices.size(); ++i) {
      expected.types[found.vertices[i]] = static_cast<int>(found.types[i]);
      expected.on_surface[found.vertices[i]] = found.on_surface[i];
    }
    return expected;
  }

  /// Are these the vertices that aren't regular of those that this rank owns?
  void expect_types(const CriticalPoints& found, const Types& expected) const {
    const std::vector<int>& types = expected.types;
    const std::vector<bool> mine = owned();
    std::array<GlobalId, 5> counts{};
    std::size_t at = 0;
    for (Id v = 0; v < input().vertices(); ++v) {
      if (types[v] == 5) continue;
      ++counts[types[v]];
      if (!mine[v]) continue;
      ASSERT_LT(at, found.vertices.size());
      EXPECT_EQ(mesh_.vertex_id(found.vertices[at]), vertex_name(v));
      EXPECT_EQ(static_cast<int>(found.types[at]), types[v]) << "vertex " << v;
      EXPECT_EQ(found.on_surface[at], expected.on_surface[v]) << "vertex " << v;
      ++at;
    }
    EXPECT_EQ(found.vertices.size(), at);
    EXPECT_EQ(found.counts, counts);
  }

  /// The gradient on this rank alone, of the whole mesh.
  DiscreteGradient gradient_on_one(const Field& field) const {
    const Mesh whole = whole_mesh();
    const auto structure = make_structure(whole, discrete_gradient_relations_of(whole.dimension()));
    return find_discrete_gradient(*structure, VertexOrder(whole, field.values.data(), field.values.size()));
  }

  void expect_pairs(const DiscreteGradient& found, const DiscreteGradient& whole,
                    const std::vector<double>& values) const;
  void expect_critical(const DiscreteGradient& found, const DiscreteGradient& whole) const;
};

TEST_P(OnRanks, critical_points_are_those_of_brute_force) {
  for (const Field& field : fields()) {
    const Types& types = once(field.name, [&] { return expected_types(field); });
    const VertexOrder order(mesh_, part_.values(field.values));
    for (const auto& kind : structure_kinds()) {
      SCOPED_TRACE(field.name + ", " + kind.name);
      const auto structure = kind.make(mesh_, critical_points_relations);
      expect_types(find_critical_points(*structure, order, with_threads(2)), types);
    }
    SCOPED_TRACE(field.name + ", by kernels");
    expect_types(find_critical_points(WorkerSpace(), order), types);
  }
}

/// What this rank knows of the pairs of vertices, cells and edges, against the gradient of the whole mesh.
void OnRanks::expect_pairs(const DiscreteGradient& found, const DiscreteGradient& whole,
                           const std::vector<double>& values) const {
  const Mesh& local = mesh_;
  const Mesh& all = whole.mesh();
  const auto rank_of = [&](Id v) { return std::make_pair(values[v], v); };
  const auto input_successor = [&](Id successor, const auto& number) {
    return successor < 0 ? successor : number(successor);
  };
  for (Id v = 0; v < local.vertices(); ++v) {
    const Id there = all.vertex_internal()(input_vertex(v));
    if (!local.owned_vertices().has(v)) {
      EXPECT_EQ(found.vertex_successor(v), DiscreteGradient::elsewhere);
      continue;
    }
    EXPECT_EQ(input_successor(found.vertex_successor(v), [&](Id s) { return input_vertex(s); }),
              input_successor(whole.vertex_successor(there), [&](Id s) { return all.vertex_input()(s); }));
    std::map<Id, Id> thirds, expected;
    found.for_each_edge_pair(v, [&](Id low, Id third) { thirds[input_vertex(low)] = input_vertex(third); });
    whole.for_each_edge_pair(there,
                             [&](Id low, Id third) { expected[all.vertex_input()(low)] = all.vertex_input()(third); });
    EXPECT_EQ(thirds, expected);
  }
  const std::vector<bool> mine = owned();
  std::vector<Id> internal(all.cells());
  for (Id t = 0; t < all.cells(); ++t) internal[all.cell_input()(t)] = t;
  for (Id t = 0; t < local.cells(); ++t) {
    const auto& quad = input().tetrahedra[input_cell(t)];
    const Id highest = *std::max_element(quad.begin(), quad.end(), [&](Id a, Id b) { return rank_of(a) < rank_of(b); });
    const Id successor = found.cell_successor(t);
    if (!mine[highest]) {
      EXPECT_EQ(successor, DiscreteGradient::elsewhere);
      continue;
    }
    const Id there = internal[input_cell(t)];
    const Id expected = whole.cell_successor(there);
    EXPECT_EQ(DiscreteGradient::leaves(successor), DiscreteGradient::leaves(expected));
    if (DiscreteGradient::leaves(successor)) {
      EXPECT_EQ(input_vertex(found.pair_of_cell(t).vertex), all.vertex_input()(whole.pair_of_cell(there).vertex));
    } else {
      EXPECT_EQ(input_successor(successor, [&](Id s) { return input_cell(s); }),
                input_successor(expected, [&](Id s) { return all.cell_input()(s); }));
    }
  }
}

/// Critical simplices of the whole mesh, as users write them, that have their highest vertex here; in their order.
void OnRanks::expect_critical(const DiscreteGradient& found, const DiscreteGradient& whole) const {
  const std::vector<bool> mine = owned();
  const auto& vertex_input = whole.mesh().vertex_input();
  const CriticalSimplices& all = whole.critical();
  CriticalSimplices expected;  // by input numbers
  for (const Id v : all.vertices) {
    if (mine[vertex_input(v)]) expected.vertices.push_back(vertex_input(v));
  }
  for (const auto& [high, low] : all.edges) {
    if (mine[vertex_input(high)]) expected.edges.push_back({vertex_input(high), vertex_input(low)});
  }
  for (const auto& [high, middle, low] : all.triangles) {
    if (!mine[vertex_input(high)]) continue;
    expected.triangles.push_back({vertex_input(high), vertex_input(middle), vertex_input(low)});
  }
  for (const Id t : all.cells) {
    Id highest = whole.mesh().encoded().cells(t, 0);
    for (int corner = 1; corner < 4; ++corner) {
      const Id v = whole.mesh().encoded().cells(t, corner);
      if (whole.order().keys()[v] > whole.order().keys()[highest]) highest = v;
    }
    if (mine[vertex_input(highest)]) expected.cells.push_back(whole.mesh().cell_input()(t));
  }
  CriticalSimplices critical = found.critical();
  for (Id& v : critical.vertices) v = input_vertex(v);
  for (auto& edge : critical.edges) edge = {input_vertex(edge[0]), input_vertex(edge[1])};
  for (auto& [high, middle, low] : critical.triangles)
    std::tie(high, middle, low) = std::make_tuple(input_vertex(high), input_vertex(middle), input_vertex(low));
  for (Id& t : critical.cells) t = input_cell(t);
  EXPECT_EQ(critical.vertices, expected.vertices);
  EXPECT_EQ(critical.edges, expected.edges);
  EXPECT_EQ(critical.triangles, expected.triangles);
  EXPECT_EQ(critical.cells, expected.cells);
  for (int dimension = 0; dimension < 4; ++dimension) EXPECT_EQ(found.counts()[dimension], all.counts()[dimension]);
  EXPECT_EQ(found.euler(), all.euler());
}

TEST_P(OnRanks, gradients_are_those_of_one_rank) {
  for (const Field& field : fields()) {
    const DiscreteGradient& whole = once(field.name, [&] { return gradient_on_one(field); });
    const VertexOrder order(mesh_, part_.values(field.values));
    const auto structure = make_structure(mesh_, discrete_gradient_relations_of(mesh_.dimension()));
    for (const auto& found :
         {find_discrete_gradient(*structure, order, with_threads(2)), find_discrete_gradient(WorkerSpace(), order)}) {
      SCOPED_TRACE(field.name);
      expect_pairs(found, whole, field.values);
      expect_critical(found, whole);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, OnRanks, every_mesh_and_partition(), mesh_and_partition);

}  // namespace gale::test
