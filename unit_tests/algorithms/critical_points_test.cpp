#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <random>

#include <gale/algorithms/critical_points.hpp>
#include <gale/base/error.hpp>
#include <gale/io/synthetic.hpp>
#include <gale/relations/explicit_structure.hpp>
#include <gale/runtime/runtime.hpp>

#include "algorithms/brute_force_types.hpp"
#include "support/every_mesh.hpp"

namespace gale::test {

namespace {

struct StructureKind {
  const char* name;
  std::function<std::unique_ptr<Structure>(const Mesh&)> make;
};

std::unique_ptr<Structure> make_runtime(const Mesh& mesh, Production production) {
  RuntimeOptions options;
  options.production = production;
  return std::make_unique<Runtime>(mesh, critical_points_relations, options);
}

std::vector<StructureKind> structure_kinds() {
  std::vector<StructureKind> kinds = {
      {"consumers", [](const Mesh& mesh) { return make_runtime(mesh, Production::consumers); }},
      {"leaders", [](const Mesh& mesh) { return make_runtime(mesh, Production::leaders); }}};
#if defined(GALE_ENABLE_KOKKOS_KERNELS)
  kinds.push_back({"explicit", [](const Mesh& mesh) { return std::make_unique<ExplicitStructure>(mesh, critical_points_relations); }});
#endif
  return kinds;
}

/// Fields on a mesh: few values, so that ties matter; one value; a slope; and infinities.
std::vector<std::vector<double>> fields_on(const InputMesh& mesh) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::mt19937 random(20261121);
  std::vector<std::vector<double>> fields(4);
  for (const auto& point : mesh.points) {
    const int any = static_cast<int>(random() % 16);
    fields[0].push_back(any - 8);
    fields[1].push_back(3.5);
    fields[2].push_back(point[0] + 0.1 * point[1]);
    fields[3].push_back(any < 3 ? -infinity : any > 12 ? infinity : any);
  }
  return fields;
}

SweepOptions with_threads(int threads) {
  SweepOptions options;
  options.threads = threads;
  return options;
}

void expect_types(const CriticalPoints& points, const std::vector<int>& types, const BruteForce& brute_force) {
  std::array<Id, 5> counts{};
  std::size_t at = 0;
  for (std::size_t v = 0; v < types.size(); ++v) {
    if (types[v] == 5) continue;
    ++counts[types[v]];
    ASSERT_LT(at, points.vertices.size());
    EXPECT_EQ(points.vertices[at], static_cast<Id>(v));
    EXPECT_EQ(static_cast<int>(points.types[at]), types[v]) << "vertex " << v;
    EXPECT_EQ(points.on_boundary[at], brute_force.on_boundary[v]) << "vertex " << v;
    ++at;
  }
  EXPECT_EQ(points.vertices.size(), at);
  EXPECT_EQ(points.counts, counts);
}

}  // namespace

class CriticalPointsOf : public EveryMesh {};

TEST_P(CriticalPointsOf, every_mesh_are_those_of_brute_force_on_every_structure) {
  const Mesh mesh = encode(input(), segmentation());
  const BruteForce& brute_force = brute_force_of(mesh_name());
  for (const auto& field : fields_on(input())) {
    const auto types = brute_force_types(input(), brute_force, field);
    const VertexOrder order(mesh, field.data(), field.size());
    for (const auto& kind : structure_kinds()) {
      SCOPED_TRACE(kind.name);
      const auto structure = kind.make(mesh);
      expect_types(find_critical_points(*structure, order, with_threads(2)), types, brute_force);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, CriticalPointsOf, every_mesh_and_segmentation(), mesh_and_segmentation);

TEST(CriticalPoints, of_one_tetrahedron_are_its_lowest_and_its_highest_vertex) {
  const InputMesh& input = mesh_named("one_tetrahedron");
  const Mesh mesh = encode(input, octree_of(input, 100));
  const std::vector<float> field = {7, 5, 6, 9};
  Runtime runtime(mesh, critical_points_relations);
  const auto points = find_critical_points(runtime, VertexOrder(mesh, field.data(), field.size()));
  EXPECT_EQ(points.vertices, (std::vector<Id>{1, 3}));
  EXPECT_EQ(points.types, (std::vector<CriticalType>{CriticalType::minimum, CriticalType::maximum}));
  EXPECT_EQ(points.on_boundary, (std::vector<std::uint8_t>{1, 1}));
}

TEST(CriticalPoints, of_a_vertex_without_tetrahedra_is_degenerate) {
  const InputMesh& input = mesh_named("isolated_vertices");
  const auto isolated = std::find_if(brute_force_of("isolated_vertices").vt.begin(), brute_force_of("isolated_vertices").vt.end(),
                                     [](const auto& star) { return star.empty(); });
  const auto vertex = static_cast<Id>(isolated - brute_force_of("isolated_vertices").vt.begin());
  const Mesh mesh = encode(input, octree_of(input, 100));
  const std::vector<float> field(input.points.size(), 1.0f);
  Runtime runtime(mesh, critical_points_relations);
  const auto points = find_critical_points(runtime, VertexOrder(mesh, field.data(), field.size()));
  const auto at = std::find(points.vertices.begin(), points.vertices.end(), vertex) - points.vertices.begin();
  ASSERT_LT(at, static_cast<std::ptrdiff_t>(points.vertices.size()));
  EXPECT_EQ(points.types[at], CriticalType::degenerate);
}

/// The counts of the synthetic meshes that other programs find too.
class CriticalPointsOfGrid : public testing::TestWithParam<int> {};

TEST_P(CriticalPointsOfGrid, are_the_known_counts) {
  const int n = GetParam();
  const auto known = n == 32 ? std::array<Id, 5>{26, 76, 88, 39, 6} : std::array<Id, 5>{134, 383, 387, 127, 22};
  const io::Dataset dataset = io::make_grid(n);
  const auto& points = std::get<io::Dataset::Points<float>>(dataset.points);
  const auto& field = std::get<std::vector<float>>(dataset.arrays.front().values);
  for (const int capacity : {7, 100, 1000000}) {
    const Mesh mesh(Tetrahedra<Id, HostMemory>(dataset.tetrahedra),
                    octree_segmentation<float, HostMemory>(Points<float, HostMemory>(points), capacity));
    const VertexOrder order(mesh, field.data(), field.size());
    for (const auto& kind : structure_kinds()) {
      const auto structure = kind.make(mesh);
      for (const int threads : {1, 8}) {
        EXPECT_EQ(find_critical_points(*structure, order, with_threads(threads)).counts, known)
            << kind.name << ", capacity " << capacity << ", " << threads << " threads";
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, CriticalPointsOfGrid, testing::Values(32, 64));

TEST(CriticalPoints, need_the_relations_that_they_read) {
  const InputMesh& input = mesh_named("one_tetrahedron");
  const Mesh mesh = encode(input, octree_of(input, 100));
  const std::vector<float> field(4, 1.0f);
  Runtime runtime(mesh, Relation::VV);
  EXPECT_THROW(find_critical_points(runtime, VertexOrder(mesh, field.data(), field.size())), Error);
}

}  // namespace gale::test
