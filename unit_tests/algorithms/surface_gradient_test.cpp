#include <algorithm>

#include <gtest/gtest.h>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/simplex_numbers.hpp>
#include <gale/base/error.hpp>
#include <gale/runtime/make_structure.hpp>

#include "algorithms/brute_force_persistence.hpp"
#include "algorithms/structure_kinds.hpp"
#include "algorithms/surface_cases.hpp"
#include "support/arrays.hpp"
#include "support/message_of.hpp"

namespace gale::test {

namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;

/// Asks a gradient for the pair of each simplex of a surface.
class SurfaceReader {
 public:
  SurfaceReader(const InputSurface& input, const Mesh& mesh)
      : mesh_(mesh), oracle_(input.vertices(), input.triangles), cells_(input), cell_(input.triangles.size()) {
    for (Id t = 0; t < mesh.cells(); ++t) cell_[mesh.cell_input()(t)] = t;
  }

  /// Has each simplex the partner that brute force finds?
  AssertionResult match(const DiscreteGradient& gradient, const BruteForceGradient& expected) const {
    for (const Simplex& vertex : oracle_.simplices(0)) {
      const auto result = expect(vertex, gradient.pair_of_vertex(gale(vertex[0])), expected);
      if (!result) return result;
    }
    for (const Simplex& edge : oracle_.simplices(1)) {
      const auto result = expect(edge, gradient.pair_of_edge(gale(edge[1]), gale(edge[0])), expected);
      if (!result) return result;
    }
    for (std::size_t t = 0; t < cell_.size(); ++t) {
      const auto result = expect(cells_.cells[t], gradient.pair_of_cell(cell_[t]), expected);
      if (!result) return result;
    }
    return AssertionSuccess();
  }

  /// Do the pairs of edges that a gradient tells of together make those with triangles?
  AssertionResult match_edge_pairs(const DiscreteGradient& gradient, const BruteForceGradient& expected) const {
    std::map<Simplex, Simplex> told, wanted;
    for (Id v = 0; v < mesh_.vertices(); ++v) {
      gradient.for_each_edge_pair(v, [&](Id low, Id third) {
        told[named({v, low})] = named({v, low, third});
        if (gradient.order().keys()[low] > gradient.order().keys()[v]) told[{}] = {};
      });
    }
    for (const auto& [simplex, partner] : expected.partner) {
      if (simplex.size() == 2 && partner.size() == 3) wanted[simplex] = partner;
    }
    return told == wanted ? AssertionSuccess()
                          : AssertionFailure() << told.size() << " edges are paired with triangles";
  }

 private:
  Id gale(Id vertex) const { return mesh_.vertex_internal()(vertex); }

  Simplex named(Simplex simplex) const {
    for (Id& v : simplex) v = mesh_.vertex_input()(v);
    std::sort(simplex.begin(), simplex.end());
    return simplex;
  }

  AssertionResult expect(const Simplex& simplex, const Partner& found, const BruteForceGradient& expected) const {
    const auto partner = expected.partner.find(simplex);
    Simplex other = simplex;
    if (found.is_critical()) {
      other.clear();
    } else {
      const Id vertex = mesh_.vertex_input()(found.vertex);
      const auto at = std::find(other.begin(), other.end(), vertex);
      if (at != other.end()) {
        other.erase(at);
      } else {
        other.push_back(vertex);
        std::sort(other.begin(), other.end());
      }
      if (other.size() != static_cast<std::size_t>(found.dimension) + 1) return AssertionFailure() << "dimension";
    }
    if (other == (partner == expected.partner.end() ? Simplex{} : partner->second)) return AssertionSuccess();
    return AssertionFailure() << "pair of " << testing::PrintToString(simplex) << " is "
                              << testing::PrintToString(other);
  }

  Mesh mesh_;
  SurfaceOracle oracle_;
  CellsOf cells_;
  std::vector<Id> cell_;  ///< by input id
};

/// The critical simplices in input ids, with the cells of each critical edge.
struct NamedCritical {
  explicit NamedCritical(const DiscreteGradient& gradient) {
    const auto& critical = gradient.critical();
    const auto& input = gradient.mesh().vertex_input();
    for (const Id v : critical.vertices) vertices.push_back(input(v));
    for (const auto& [high, low] : critical.edges) edges.push_back({input(high), input(low)});
    for (const Id t : critical.cells) cells.push_back(gradient.mesh().cell_input()(t));
    for (const Id t : critical.star) star.push_back(gradient.mesh().cell_input()(t));
    star_begin = critical.star_begin;
  }

  auto all() const { return std::tie(vertices, edges, cells, star, star_begin); }
  friend bool operator==(const NamedCritical& a, const NamedCritical& b) { return a.all() == b.all(); }

  std::vector<Id> vertices, cells, star, star_begin;
  std::vector<std::array<Id, 2>> edges;
};

/// Two gradients of one mesh.
void expect_same_gradient(const DiscreteGradient& a, const DiscreteGradient& b) {
  EXPECT_EQ(to_vector(a.vertex_successors()), to_vector(b.vertex_successors()));
  EXPECT_EQ(to_vector(a.cell_successors()), to_vector(b.cell_successors()));
  EXPECT_TRUE(NamedCritical(a) == NamedCritical(b));
}

}  // namespace

class SurfaceGradient : public SurfaceTest {};

TEST_P(SurfaceGradient, is_that_of_brute_force_whatever_finds_it) {
  const InputSurface& input = surface();
  for (const Field& field : fields_on(points_of_surface(input))) {
    SCOPED_TRACE(field.name);
    const BruteForceGradient expected(input, field.values);
    std::vector<NamedCritical> critical;
    for (const int capacity : {4, 100}) {
      const Mesh mesh = encode(input, capacity);
      const SurfaceReader reader(input, mesh);
      const VertexOrder order(mesh, field.values.data(), field.values.size());
      const DiscreteGradient first = find_discrete_gradient(order);
      EXPECT_TRUE(reader.match(first, expected));
      EXPECT_TRUE(reader.match_edge_pairs(first, expected));
      EXPECT_EQ(first.euler(), input.euler);
      EXPECT_EQ(first.critical().euler(), input.euler);
      EXPECT_EQ(first.counts()[3], 0);
      EXPECT_TRUE(first.critical().triangles.empty());
      for (const auto& kind : structure_kinds()) {
        SCOPED_TRACE(kind.name);
        const auto structure = kind.make(mesh, discrete_gradient_relations_of(2));
        for (const int threads : {1, 8})
          expect_same_gradient(find_discrete_gradient(*structure, order, with_threads(threads)), first);
      }
      DeviceSweepOptions small;
      small.memory = 1 << 16;
      for (const DeviceSweepOptions& options : {DeviceSweepOptions(), small})
        expect_same_gradient(find_discrete_gradient(WorkerSpace(), order, options), first);
      critical.emplace_back(first);
      EXPECT_TRUE(critical.back() == critical.front()) << "capacities";
    }
  }
}

/// The stars in CriticalSimplices are those of the input, by input id.
TEST_P(SurfaceGradient, has_the_triangles_of_critical_edges) {
  const InputSurface& input = surface();
  const Mesh mesh = encode(input, 20);
  const auto field = random_field(points_of_surface(input), 3);
  const NamedCritical found(find_discrete_gradient(VertexOrder(mesh, field.data(), field.size())));
  ASSERT_EQ(found.star_begin.size(), found.edges.size() + 1);
  for (std::size_t i = 0; i < found.edges.size(); ++i) {
    std::vector<Id> star;
    for (std::size_t t = 0; t < input.triangles.size(); ++t) {
      const auto& corners = input.triangles[t];
      if (std::count(corners.begin(), corners.end(), found.edges[i][0]) +
              std::count(corners.begin(), corners.end(), found.edges[i][1]) ==
          2)
        star.push_back(static_cast<Id>(t));
    }
    EXPECT_EQ(std::vector<Id>(found.star.begin() + found.star_begin[i], found.star.begin() + found.star_begin[i + 1]),
              star);
  }
}

TEST_P(SurfaceGradient, has_critical_edges_with_the_numbers_of_the_input) {
  const InputSurface& input = surface();
  const Mesh mesh = encode(input, 20);
  const auto field = random_field(points_of_surface(input), 4);
  const DiscreteGradient gradient = find_discrete_gradient(VertexOrder(mesh, field.data(), field.size()));
  const SurfaceOracle oracle(input.vertices(), input.triangles);
  const auto& edges = oracle.simplices(1);
  const SimplexNumbers numbers = number_simplices(mesh, {gradient.critical().edges, {}, {}});
  const auto found = NamedCritical(gradient).edges;
  for (std::size_t i = 0; i < found.size(); ++i) {
    Simplex edge(found[i].begin(), found[i].end());
    std::sort(edge.begin(), edge.end());
    EXPECT_EQ(numbers.edges[i], std::distance(edges.begin(), edges.find(edge)));
  }
  EXPECT_TRUE(std::is_sorted(numbers.edges.begin(), numbers.edges.end()));
}

INSTANTIATE_TEST_SUITE_P(Tests, SurfaceGradient, surface_names(), surface_name);

TEST(SurfaceGradients, of_random_surfaces_are_those_of_brute_force) {
  for (unsigned seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE(seed);
    const InputSurface input = random_surface(seed);
    const std::vector<Field> fields = fields_on(points_of_surface(input));
    const Field& field = fields[seed % fields.size()];
    const Mesh mesh = encode(input, 1 + seed % 12);
    const VertexOrder order(mesh, field.values.data(), field.values.size());
    const BruteForceGradient expected(input, field.values);
    const DiscreteGradient gradient = find_discrete_gradient(order);
    EXPECT_TRUE(SurfaceReader(input, mesh).match(gradient, expected));
    expect_same_gradient(find_discrete_gradient(WorkerSpace(), order), gradient);
    const NamedPairs pairs = brute_force_pairs(field.values, expected);
    const NamedPairs found = named_pairs(gradient, find_persistence_pairs(gradient));
    EXPECT_EQ(found.pairs, pairs.pairs);
    EXPECT_EQ(found.essential, pairs.essential);
  }
}

TEST(SurfaceGradients, have_no_triangles_that_are_no_cells) {
  const Mesh mesh = encode(surfaces().at("plane"), 20);
  const std::vector<float> field(mesh.vertices(), 1);
  const DiscreteGradient gradient = find_discrete_gradient(VertexOrder(mesh, field.data(), field.size()));
  EXPECT_EQ(message_of([&] { gradient.pair_of_triangle(0, 0, {}); }),
            "pair_of_triangle is for meshes of tetrahedra: triangles are cells here");
  EXPECT_EQ(message_of([&] {
              number_simplices(mesh, {{}, {{0, 1, 2}}, {}});
            }),
            "1 triangles of a mesh of triangles are to be numbered: these are its cells, and have their input ids");
  MorseSmaleParts parts;
  parts.separatrices2 = true;
  EXPECT_EQ(message_of([&] { find_morse_smale_complex(gradient, parts); }),
            "a mesh of triangles has no 2-separatrices: those of a mesh of tetrahedra consist of triangles");
}

TEST(SurfaceGradients, of_a_known_plane_have_its_critical_simplices) {
  const KnownPlane plane(600);
  for (const int capacity : {7, 100, 1000000}) {
    const Mesh mesh = encode(plane.surface, capacity);
    const VertexOrder order(mesh, plane.field.data(), plane.field.size());
    const std::array<Id, 4> expected = {1832, 3383, 1552, 0};
    const auto structure = make_structure(mesh, discrete_gradient_relations_of(2));
    EXPECT_EQ(find_discrete_gradient(*structure, order, with_threads(8)).critical().counts(), expected);
    EXPECT_EQ(find_discrete_gradient(WorkerSpace(), order).critical().counts(), expected);
  }
}

}  // namespace gale::test
