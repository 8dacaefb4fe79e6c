#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include <gale/algorithms/morse_smale.hpp>
#include <gale/distributed/distributed_manifolds.hpp>
#include <gale/distributed/distributed_separatrices.hpp>
#include <gale/runtime/make_structure.hpp>

#include "algorithms/fields.hpp"
#include "distributed/every_partition.hpp"
#include "support/arrays.hpp"
#include "support/segmentations.hpp"
#include "support/with_threads.hpp"

namespace gale::test {

class ComplexOnRanks : public EveryPartition {
 protected:
  /// The complex of the whole mesh, on this rank alone.
  MorseSmaleComplex complex_on_one(const std::vector<double>& values) const {
    const Mesh whole = encode(input(), 100);
    const auto structure = make_structure(whole, discrete_gradient_relations);
    return find_morse_smale_complex(
        *structure, find_discrete_gradient(*structure, VertexOrder(whole, values.data(), values.size())));
  }

  DistributedGradient gradient_of(const std::vector<double>& values) const {
    const DistributedOrder order(mesh_, part_.values(values));
    return find_discrete_gradient(*make_structure(mesh_.local(), discrete_gradient_relations), order);
  }

  /// Has each local vertex the number that it has in the whole mesh?
  void expect_numbers(const Array<const GlobalId, HostMemory>& found, const std::vector<Id>& expected) const {
    ASSERT_EQ(found.extent(0), mesh_.vertex_ids().extent(0));
    for (std::size_t i = 0; i < found.extent(0); ++i) {
      const Id v = vertex_named(mesh_.vertex_ids()(i));
      EXPECT_EQ(found(i), expected[v]) << "vertex " << v;
    }
  }

  void expect_between(const DistributedSeparatrices& found, bool falls) const;
  void expect_paths(const DistributedSeparatrices& found, const Separatrices<Id>& whole, const Id* whole_input,
                    Id (*number)(GlobalId)) const;
};

TEST_P(ComplexOnRanks, manifolds_are_those_of_one_rank) {
  for (const Field& field : {fields_on(input())[0], fields_on(input())[2]}) {
    SCOPED_TRACE(field.name);
    const MorseSmaleComplex whole = complex_on_one(field.values);
    const DistributedManifolds found = find_manifolds(gradient_of(field.values));
    expect_numbers(found.descending, to_vector(whole.descending_manifold));
    expect_numbers(found.ascending, to_vector(whole.ascending_manifold));
    expect_numbers(found.morse_smale, to_vector(whole.morse_smale_manifold));
    EXPECT_EQ(found.morse_smale_manifolds, whole.morse_smale_manifolds);
  }
}

/// A path: where it starts, where it ends, and the input's numbers of the simplices on it.
using NamedPath = std::tuple<GlobalId, GlobalId, std::vector<Id>>;

/// The sum over all ranks of how often each of the paths is there must be how often it is in the whole mesh.
void ComplexOnRanks::expect_paths(const DistributedSeparatrices& found, const Separatrices<Id>& whole,
                                  const Id* whole_input, Id (*number)(GlobalId)) const {
  std::map<NamedPath, std::int64_t> here, expected;
  for (Offset i = 0; i < found.count(); ++i) {
    std::vector<Id> cells;
    for (Offset k = found.begin[i]; k < found.begin[i + 1]; ++k) cells.push_back(number(found.cells[k]));
    ++here[{found.sources[i], found.destinations[i], cells}];
  }
  for (Id i = 0; i < whole.count(); ++i) {
    std::vector<Id> cells;
    for (const Id* cell = whole.first(i); cell != whole.last(i); ++cell) cells.push_back(whole_input[*cell]);
    ++expected[{whole.sources[i], whole.destinations[i], cells}];
  }
  for (const auto& [path, times] : here) EXPECT_EQ(expected.count(path), 1u) << "from " << std::get<0>(path);
  std::vector<std::int64_t> counts;
  for (const auto& [path, times] : expected) counts.push_back(here.count(path) == 0 ? 0 : here.at(path));
  ranks_.sum(counts.data(), static_cast<int>(counts.size()));
  std::size_t at = 0;
  for (const auto& [path, times] : expected) EXPECT_EQ(counts[at++], times) << "from " << std::get<0>(path);
}

/// Before each cell but the first of a path stands what it shares with the cell before: the edge of two vertices, the
/// triangle of two tetrahedra. Before the first stands the source, which has it as a vertex, or is a face of it.
void ComplexOnRanks::expect_between(const DistributedSeparatrices& found, bool falls) const {
  const auto vertices_of = [&](GlobalId cell) {
    std::set<GlobalId> vertices;
    if (falls) return std::set<GlobalId>{cell};
    for (const Id v : input().tetrahedra[tetrahedron_named(cell)]) vertices.insert(vertex_name(v));
    return vertices;
  };
  ASSERT_EQ(found.between.size(), found.cells.size());
  ASSERT_EQ(found.sources_here.size(), found.sources.size());
  for (Offset i = 0; i < found.count(); ++i) {
    for (Offset k = found.begin[i]; k < found.begin[i + 1]; ++k) {
      std::set<GlobalId> between(found.between[k].begin(), found.between[k].end());
      EXPECT_EQ(between.erase(-1), falls ? 1u : 0u);
      EXPECT_TRUE(std::is_sorted(found.between[k].begin(), found.between[k].end() - (falls ? 1 : 0)));
      const std::set<GlobalId> here = vertices_of(found.cells[k]);
      for (const GlobalId v : falls ? here : between) EXPECT_TRUE((falls ? between : here).count(v) == 1) << v;
      if (k == found.begin[i]) continue;
      const std::set<GlobalId> before = vertices_of(found.cells[k - 1]);
      for (const GlobalId v : falls ? before : between) EXPECT_TRUE((falls ? between : before).count(v) == 1) << v;
      if (!falls) continue;
      const auto &a = input().points[vertex_named(found.between[k][0])],
                 &b = input().points[vertex_named(found.between[k][1])];
      for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(found.between_points[k][axis], (a[axis] + b[axis]) / 2);
    }
  }
}

TEST_P(ComplexOnRanks, separatrices_are_those_of_one_rank) {
  for (const Field& field : {fields_on(input())[0], fields_on(input())[4]}) {
    SCOPED_TRACE(field.name);
    const MorseSmaleComplex whole = complex_on_one(field.values);
    const Mesh& mesh = whole.gradient.mesh();
    const DistributedGradient gradient = gradient_of(field.values);
    const auto descending = find_descending_separatrices(gradient), ascending = find_ascending_separatrices(gradient);
    expect_paths(descending, whole.descending, mesh.vertex_input().data(), vertex_named);
    expect_paths(ascending, whole.ascending, mesh.tetrahedron_input().data(), tetrahedron_named);
    expect_between(descending, true);
    expect_between(ascending, false);
    for (std::size_t i = 0; i < descending.cells.size(); ++i)
      EXPECT_EQ(descending.points[i], input().points[vertex_named(descending.cells[i])]);
    for (std::size_t i = 0; i < ascending.cells.size(); ++i) {
      const auto& quad = input().tetrahedra[tetrahedron_named(ascending.cells[i])];
      for (int axis = 0; axis < 3; ++axis) {
        double sum = 0;
        for (const Id v : quad) sum += input().points[v][axis];
        EXPECT_NEAR(ascending.points[i][axis], sum / 4, 1e-9);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, ComplexOnRanks, every_mesh_and_partition(), mesh_and_partition);

TEST(DistributedManifolds, take_few_rounds_for_long_paths) {
  const Communicator ranks(MPI_COMM_WORLD);
  const InputMesh& input = mesh_named("slivers");  // a strip of 60 vertices
  const GivenPart part = part_of(input, "random", ranks);
  const DistributedMesh mesh = distribute(ranks, part, "random");
  std::vector<int> values(input.vertices());
  for (Id v = 0; v < input.vertices(); ++v) values[v] = v;
  const auto structure = make_structure(mesh.local(), discrete_gradient_relations);
  const auto manifolds =
      find_manifolds(find_discrete_gradient(*structure, DistributedOrder(mesh, part.values(values))));
  for (std::size_t i = 0; i < manifolds.descending.extent(0); ++i) EXPECT_EQ(manifolds.descending(i), 0);
  EXPECT_LE(manifolds.rounds, 2 * 6);  // 2^6 steps are more than any path has
  if (ranks.size() == 1) EXPECT_EQ(manifolds.rounds, 0);
}

}  // namespace gale::test
