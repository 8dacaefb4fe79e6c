#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <gale/algorithms/critical_points.hpp>
#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/merge_tree.hpp>
#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/persistence.hpp>
#include <gale/runtime/make_structure.hpp>

#include "algorithms/fields.hpp"
#include "support/segmentations.hpp"

/// What kernels find where their lists and their lanes are too small at first: the same as consumers on the host.
namespace gale::test {

namespace {

/// Copies of a mesh that have nothing in common.
InputMesh copies_of(const InputMesh& one, int count) {
  InputMesh all;
  for (int copy = 0; copy < count; ++copy) {
    const Id first = all.vertices();
    for (auto point : one.points) {
      point[0] += 100 * copy;
      all.points.push_back(point);
    }
    for (auto tetrahedron : one.tetrahedra) {
      for (Id& vertex : tetrahedron) vertex += first;
      all.tetrahedra.push_back(tetrahedron);
    }
  }
  return all;
}

std::vector<std::pair<Id, Id>> edge_pairs_of(const DiscreteGradient& gradient, Id high) {
  std::vector<std::pair<Id, Id>> pairs;
  gradient.for_each_edge_pair(high, [&](Id low, Id third) { pairs.push_back({low, third}); });
  return pairs;
}

void expect_equal(const DiscreteGradient& found, const DiscreteGradient& expected) {
  const Mesh& mesh = found.mesh();
  EXPECT_EQ(found.critical().vertices, expected.critical().vertices);
  EXPECT_EQ(found.critical().edges, expected.critical().edges);
  EXPECT_EQ(found.critical().triangles, expected.critical().triangles);
  EXPECT_EQ(found.critical().cells, expected.critical().cells);
  EXPECT_EQ(found.critical().star, expected.critical().star);
  for (Id v = 0; v < mesh.vertices(); ++v) {
    ASSERT_EQ(found.vertex_successor(v), expected.vertex_successor(v)) << v;
    ASSERT_EQ(edge_pairs_of(found, v), edge_pairs_of(expected, v)) << v;
  }
  for (Id t = 0; t < mesh.cells(); ++t) ASSERT_EQ(found.cell_successor(t), expected.cell_successor(t)) << t;
}

void expect_the_same_on_either_side(const InputMesh& input, unsigned seed) {
  const Mesh mesh = encode(input, 100);
  const auto field = random_field(input, seed);
  const VertexOrder order(mesh, field.data(), field.size());
  const auto structure = make_structure(mesh, critical_points_relations | discrete_gradient_relations);
  const CriticalPoints points = find_critical_points(WorkerSpace(), order),
                       expected = find_critical_points(*structure, order);
  EXPECT_EQ(points.vertices, expected.vertices);
  EXPECT_EQ(points.types, expected.types);
  EXPECT_EQ(points.on_surface, expected.on_surface);
  const DiscreteGradient gradient = find_discrete_gradient(*structure, order);
  ASSERT_GT(gradient.critical().edges.size(), static_cast<std::size_t>(mesh.vertices() / 16 + 1024));
  MergeTreeOptions by_threads;
  by_threads.consumers = ConsumerPlace::host;
  const auto trees = find_merge_trees(WorkerSpace(), order), on_host = find_merge_trees(order, by_threads);
  for (int tree = 0; tree < 3; ++tree) {
    EXPECT_EQ(trees[tree].vertices, on_host[tree].vertices);
    EXPECT_EQ(trees[tree].arcs, on_host[tree].arcs);
    EXPECT_EQ(trees[tree].arc_of, on_host[tree].arc_of);
  }
  expect_equal(find_discrete_gradient(WorkerSpace(), order), gradient);
}

}  // namespace

TEST(DeviceAlgorithms, make_room_for_noise) { expect_the_same_on_either_side(holed_grid(30), 1); }

/// Two thirds of the vertices have 70 neighbours and more; so do their links.
TEST(DeviceAlgorithms, hand_on_what_lanes_cannot_hold) {
  expect_the_same_on_either_side(copies_of(cone_over_caps(70, 2), 600), 2);
  expect_the_same_on_either_side(copies_of(cone_over_caps(90, 3), 400), 3);
}

/// Compares what walls and columns find in grids that have all their cubes, where pairs are told by directions.
TEST(DeviceAlgorithms, find_pairs_in_grids_that_walls_and_columns_follow) {
  ComputeOptions by_threads;
  by_threads.consumers = ConsumerPlace::host;
  MorseSmaleParts with_walls;
  with_walls.separatrices2 = true;
  for (const std::array<Id, 3>& points : {std::array<Id, 3>{2, 2, 2}, {2, 5, 3}, {6, 2, 4}, {9, 8, 10}, {17, 12, 3}}) {
    const Mesh mesh{Grid(points)};
    for (const unsigned different : {3u, 1000000u}) {
      std::mt19937 random(different);
      std::vector<int> field(mesh.vertices());
      for (int& value : field) value = static_cast<int>(random() % different);
      const VertexOrder order(mesh, field.data(), field.size());
      const DiscreteGradient found = find_discrete_gradient(WorkerSpace(), order),
                             expected = find_discrete_gradient(order, by_threads);
      expect_equal(found, expected);
      const detail::VertexSteps steps = found.store().vertex_steps();
      ASSERT_NE(steps.codes, nullptr);
      for (Id a = 0; a < mesh.vertices(); ++a) {
        ASSERT_EQ(steps[a], expected.vertex_successor(a)) << a;
        const Id b = (a + 1) % mesh.vertices();  // an edge, but for the last in a row
        ASSERT_EQ(found.triangle_of_edge(a, b), expected.triangle_of_edge(a, b)) << a;
      }
      const PersistencePairs pairs = find_persistence_pairs(found), expected_pairs = find_persistence_pairs(expected);
      for (int d = 0; d < 3; ++d) {
        ASSERT_EQ(pairs.pairs[d].size(), expected_pairs.pairs[d].size());
        for (std::size_t i = 0; i < pairs.pairs[d].size(); ++i) {
          EXPECT_EQ(pairs.pairs[d][i].lower, expected_pairs.pairs[d][i].lower);
          EXPECT_EQ(pairs.pairs[d][i].upper, expected_pairs.pairs[d][i].upper);
        }
      }
      const MorseSmaleComplex complex = find_morse_smale_complex(found, with_walls, by_threads),
                              expected_complex = find_morse_smale_complex(expected, with_walls, by_threads);
      EXPECT_EQ(complex.connectors.cells, expected_complex.connectors.cells);
      EXPECT_EQ(complex.descending_walls.cells, expected_complex.descending_walls.cells);
    }
  }
}

TEST(DeviceAlgorithms, of_a_field_in_the_devices_memory) {
  const InputMesh input = holed_grid(9);
  const Mesh mesh = encode(input, 100);
  const auto field = random_field(input, 4);
  const auto there = Kokkos::create_mirror_view_and_copy(
      WorkerMemory(), Kokkos::View<const double*, HostMemory, Kokkos::MemoryUnmanaged>(field.data(), field.size()));
  const VertexOrder order(mesh, there), expected(mesh, field.data(), field.size());
  EXPECT_TRUE(std::equal(order.keys(), order.keys() + mesh.vertices(), expected.keys()));
  EXPECT_EQ(find_critical_points(WorkerSpace(), order).vertices,
            find_critical_points(WorkerSpace(), expected).vertices);
}

}  // namespace gale::test
