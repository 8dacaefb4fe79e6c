#include <gtest/gtest.h>

#include <gale/algorithms/critical_points.hpp>
#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/io/synthetic.hpp>

#include "algorithms/structure_kinds.hpp"

// What other programs find too on the synthetic meshes.

namespace gale::test {

struct KnownCounts {
  int n;
  std::array<GlobalId, 5> points;  ///< by CriticalType
  std::array<Id, 4> simplices;     ///< by dimension
  std::vector<int> threads, capacities;
};

class KnownCountsOfGrid : public testing::TestWithParam<KnownCounts> {};

TEST_P(KnownCountsOfGrid, are_found_on_every_structure) {
  const KnownCounts& known = GetParam();
  const io::Dataset dataset = io::make_grid(known.n);
  const auto& points = std::get<io::Dataset::Points<float>>(dataset.points);
  const auto& field = std::get<std::vector<float>>(dataset.arrays.front().values);
  for (const int capacity : known.capacities) {
    const Mesh mesh(Tetrahedra<Id, HostMemory>(dataset.tetrahedra),
                    octree_segmentation<float, HostMemory>(Points<float, HostMemory>(points), capacity));
    const VertexOrder order(mesh, field.data(), field.size());
    for (const auto& kind : structure_kinds()) {
      const auto structure = kind.make(mesh, critical_points_relations | discrete_gradient_relations);
      for (const int threads : known.threads) {
        SCOPED_TRACE(kind.name + ", capacity " + std::to_string(capacity) + ", threads " + std::to_string(threads));
        EXPECT_EQ(find_critical_points(*structure, order, with_threads(threads)).counts, known.points);
        const auto gradient = find_discrete_gradient(*structure, order, with_threads(threads));
        EXPECT_EQ(gradient.critical().counts(), known.simplices);
        EXPECT_EQ(gradient.critical().euler(), 1);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Tests, KnownCountsOfGrid,
    testing::Values(KnownCounts{32, {26, 76, 88, 39, 6}, {26, 59, 37, 3}, {1, 8}, {7, 100, 1000000}},
                    KnownCounts{64, {134, 383, 387, 127, 22}, {134, 356, 263, 40}, {8}, {100}}),
    [](const auto& info) { return std::to_string(info.param.n); });

}  // namespace gale::test
