#include <gtest/gtest.h>

#include <gale/algorithms/critical_points.hpp>
#include <gale/base/error.hpp>
#include <gale/runtime/make_structure.hpp>

#include "algorithms/brute_force_types.hpp"
#include "algorithms/fields.hpp"
#include "algorithms/structure_kinds.hpp"
#include "support/every_mesh.hpp"
#include "support/message_of.hpp"

namespace gale::test {

namespace {

void expect_types(const CriticalPoints& points, const std::vector<int>& types, const BruteForce& brute_force) {
  std::array<GlobalId, 5> counts{};
  std::size_t at = 0;
  for (std::size_t v = 0; v < types.size(); ++v) {
    if (types[v] == 5) continue;
    ++counts[types[v]];
    ASSERT_LT(at, points.vertices.size());
    EXPECT_EQ(points.vertices[at], static_cast<Id>(v));
    EXPECT_EQ(static_cast<int>(points.types[at]), types[v]) << "vertex " << v;
    EXPECT_EQ(points.on_surface[at], brute_force.on_surface[v]) << "vertex " << v;
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
  const auto fields = fields_on(input());
  std::vector<std::vector<int>> types;
  for (const auto& field : fields) types.push_back(brute_force_types(input(), brute_force, field.values));
  for (const auto& kind : structure_kinds()) {
    const auto structure = kind.make(mesh, critical_points_relations);
    for (std::size_t i = 0; i < fields.size(); ++i) {
      SCOPED_TRACE(kind.name + ", " + fields[i].name);
      const VertexOrder order(mesh, fields[i].values.data(), fields[i].values.size());
      expect_types(find_critical_points(*structure, order, with_threads(2)), types[i], brute_force);
    }
  }
}

TEST_P(CriticalPointsOf, the_workers_space_are_those_of_consumers) {
  const Mesh mesh = encode(input(), segmentation());
  const auto structure = make_structure(mesh, critical_points_relations);
  DeviceSweepOptions small;
  small.memory = 1 << 16;
  for (const Field& field : fields_on(input())) {
    SCOPED_TRACE(field.name);
    const VertexOrder order(mesh, field.values.data(), field.values.size());
    const CriticalPoints expected = find_critical_points(*structure, order);
    for (const DeviceSweepOptions& options : {DeviceSweepOptions(), small}) {
      const CriticalPoints found = find_critical_points(WorkerSpace(), order, options);
      EXPECT_EQ(found.vertices, expected.vertices);
      EXPECT_EQ(found.types, expected.types);
      EXPECT_EQ(found.on_surface, expected.on_surface);
      EXPECT_EQ(found.counts, expected.counts);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, CriticalPointsOf, every_mesh_and_segmentations_in_turn(), mesh_and_segmentation);

TEST(CriticalPoints, of_one_tetrahedron_are_its_lowest_and_its_highest_vertex) {
  const Mesh mesh = encode(mesh_named("one_tetrahedron"), 100);
  const std::vector<float> field = {7, 5, 6, 9};
  const auto runtime = make_structure(mesh, critical_points_relations);
  const auto points = find_critical_points(*runtime, VertexOrder(mesh, field.data(), field.size()));
  EXPECT_EQ(points.vertices, (std::vector<Id>{1, 3}));
  EXPECT_EQ(points.types, (std::vector<CriticalType>{CriticalType::minimum, CriticalType::maximum}));
  EXPECT_EQ(points.on_surface, (std::vector<std::uint8_t>{1, 1}));
}

TEST(CriticalPoints, of_a_vertex_without_tetrahedra_is_degenerate) {
  const InputMesh& input = mesh_named("isolated_vertices");
  const auto isolated =
      std::find_if(brute_force_of("isolated_vertices").vt.begin(), brute_force_of("isolated_vertices").vt.end(),
                   [](const auto& star) { return star.empty(); });
  const auto vertex = static_cast<Id>(isolated - brute_force_of("isolated_vertices").vt.begin());
  const Mesh mesh = encode(input, 100);
  const std::vector<float> field(input.points.size(), 1.0f);
  const auto runtime = make_structure(mesh, critical_points_relations);
  const auto points = find_critical_points(*runtime, VertexOrder(mesh, field.data(), field.size()));
  const auto at = std::find(points.vertices.begin(), points.vertices.end(), vertex) - points.vertices.begin();
  ASSERT_LT(at, static_cast<std::ptrdiff_t>(points.vertices.size()));
  EXPECT_EQ(points.types[at], CriticalType::degenerate);
}

TEST(CriticalPoints, need_the_relations_that_they_read) {
  const Mesh mesh = encode(mesh_named("one_tetrahedron"), 100);
  const std::vector<float> field(4, 1.0f);
  const auto runtime = make_structure(mesh, Relation::VV);
  EXPECT_THROW(find_critical_points(*runtime, VertexOrder(mesh, field.data(), field.size())), Error);
}

TEST(CriticalPoints, refuse_the_order_of_another_mesh) {
  const InputMesh& input = mesh_named("one_tetrahedron");
  const InputMesh& larger = mesh_named("holed_grid_9");
  const Mesh mesh = encode(input, 100), other = encode(larger, 100);
  const std::vector<float> field(input.points.size(), 1.0f);
  const VertexOrder order(mesh, field.data(), field.size());
  const auto runtime = make_structure(other, critical_points_relations);
  EXPECT_EQ(message_of([&] { find_critical_points(*runtime, order); }),
            "the vertex order is of a mesh of 4 vertices and 1 tetrahedra, the structure of another one of " +
                std::to_string(other.vertices()) + " vertices and " + std::to_string(other.cells()) + " tetrahedra");
}

TEST(CriticalPoints, take_the_order_of_a_copy_of_the_mesh) {
  const Mesh mesh = encode(mesh_named("one_tetrahedron"), 100);
  const Mesh copy = mesh;
  const std::vector<float> field(4, 1.0f);
  const auto runtime = make_structure(copy, critical_points_relations);
  EXPECT_EQ(find_critical_points(*runtime, VertexOrder(mesh, field.data(), 4)).vertices.size(), 2u);
  EXPECT_FALSE(mesh == encode(mesh_named("one_tetrahedron"), 100)) << "of equal tetrahedra, but not the same";
}

}  // namespace gale::test
