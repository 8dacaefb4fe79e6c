#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include <gale/algorithms/critical_points.hpp>
#include <gale/algorithms/merge_tree.hpp>
#include <gale/algorithms/simplify_field.hpp>
#include <gale/algorithms/surface_vertices.hpp>
#include <gale/runtime/make_structure.hpp>

#include "support/surfaces.hpp"

namespace gale::test {
namespace {

std::vector<float> noise(Id vertices, int levels) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> level(0, levels);
  std::vector<float> values(vertices);
  for (float& value : values) value = static_cast<float>(level(random));
  return values;
}

/// How many components the graph of `edges` has among `vertices`.
int components(const std::set<Id>& vertices, const std::vector<std::array<Id, 2>>& edges) {
  std::map<Id, Id> leader;
  for (const Id v : vertices) leader[v] = v;
  const auto find = [&](Id v) {
    while (leader[v] != v) v = leader[v];
    return v;
  };
  for (const auto& [a, b] : edges) {
    if (vertices.count(a) != 0 && vertices.count(b) != 0) leader[find(a)] = find(b);
  }
  return static_cast<int>(
      std::count_if(leader.begin(), leader.end(), [](const auto& one) { return one.first == one.second; }));
}

/// What semantics say of a vertex, from the triangles alone.
struct Expected {
  CriticalType type;
  bool on_boundary;
};

Expected expected_at(const InputSurface& surface, const std::vector<float>& values, Id v) {
  const auto is_lower = [&](Id other) { return std::make_pair(values[other], other) < std::make_pair(values[v], v); };
  std::set<Id> lower, upper;
  std::vector<std::array<Id, 2>> link;
  std::map<Id, int> triangles_of_edge;
  for (const auto& triangle : surface.triangles) {
    if (std::find(triangle.begin(), triangle.end(), v) == triangle.end()) continue;
    std::vector<Id> others;
    for (const Id corner : triangle) {
      if (corner == v) continue;
      others.push_back(corner);
      (is_lower(corner) ? lower : upper).insert(corner);
      ++triangles_of_edge[corner];
    }
    link.push_back({others[0], others[1]});
  }
  const int l = components(lower, link), u = components(upper, link);
  const bool on_boundary = std::any_of(triangles_of_edge.begin(), triangles_of_edge.end(),
                                       [](const auto& edge) { return edge.second == 1; });
  const std::map<std::pair<int, int>, CriticalType> types = {
      {{0, 1}, CriticalType::minimum}, {{1, 0}, CriticalType::maximum}, {{1, 1}, CriticalType::regular},
      {{2, 1}, CriticalType::saddle1}, {{1, 2}, CriticalType::saddle1}, {{2, 2}, CriticalType::saddle1}};
  const auto type = types.find({l, u});
  return {type == types.end() ? CriticalType::degenerate : type->second, on_boundary};
}

void expect_same(const CriticalPoints& one, const CriticalPoints& other) {
  EXPECT_EQ(one.vertices, other.vertices);
  EXPECT_EQ(one.types, other.types);
  EXPECT_EQ(one.on_surface, other.on_surface);
}

TEST(CriticalPointsOfSurfaces, are_what_their_links_say) {
  for (const auto& [name, surface] : surfaces()) {
    SCOPED_TRACE(name);
    const auto values = noise(surface.vertices(), 7);
    std::vector<Id> vertices;
    std::vector<CriticalType> types;
    std::vector<std::uint8_t> on_surface;
    for (Id v = 0; v < surface.vertices(); ++v) {
      const Expected expected = expected_at(surface, values, v);
      if (expected.type == CriticalType::regular) continue;
      vertices.push_back(v);
      types.push_back(expected.type);
      on_surface.push_back(expected.on_boundary);
    }
    for (const int capacity : {4, 64}) {
      const Mesh mesh = encode(surface, capacity);
      const VertexOrder order(mesh, values.data(), values.size());
      const CriticalPoints found = find_critical_points(order);
      EXPECT_EQ(found.vertices, vertices);
      EXPECT_EQ(found.types, types);
      EXPECT_EQ(found.on_surface, on_surface);
      expect_same(find_critical_points(WorkerSpace(), order), found);
#if defined(GALE_ENABLE_KOKKOS_KERNELS)
      StructureOptions explicit_way;
      explicit_way.way = Way::explicit_;
      const auto structure = make_structure(mesh, critical_points_relations, explicit_way);
      expect_same(find_critical_points(*structure, order), found);
#endif
      const auto flags = surface_vertices(mesh);
      int wrong = 0;
      for (Id v = 0; v < mesh.vertices(); ++v)
        wrong += (flags(v) != 0) != expected_at(surface, values, mesh.vertex_input()(v)).on_boundary;
      EXPECT_EQ(wrong, 0);
    }
  }
}

/// `plane:600` of the command, whose figures TTK confirmed.
class Plane600 : public testing::Test {
 protected:
  Plane600()
      : surface_(ordered_plane(600)),
        mesh_(encode(surface_, 64)),
        values_(plane_values(600)),
        order_(mesh_, values_.data(), values_.size()) {}

  InputSurface surface_;
  Mesh mesh_;
  std::vector<float> values_;
  VertexOrder order_;
};

TEST_F(Plane600, has_as_many_critical_points_as_ttk_finds) {
  const auto counts = find_critical_points(order_).counts;
  EXPECT_EQ(counts, (std::array<GlobalId, 5>{1832, 3470, 0, 1750, 49}));
}

TEST_F(Plane600, has_a_contour_tree_of_as_many_nodes_as_ttk_finds) {
  const MergeTree tree = find_merge_tree(order_, Tree::contour);
  EXPECT_EQ(tree.vertices.size(), 7062u);
  EXPECT_EQ(tree.arcs.size(), 7061u);
}

/// How many minima of a connected surface outlast a threshold by the elder rule: all vertices in order, joined along
/// their edges. `sign` -1 for maxima.
GlobalId lasting_extrema(const InputSurface& surface, const std::vector<float>& values, double threshold, int sign) {
  const auto before = [&](Id a, Id b) {
    return sign > 0 ? std::make_pair(values[a], a) < std::make_pair(values[b], b)
                    : std::make_pair(values[a], a) > std::make_pair(values[b], b);
  };
  std::vector<std::vector<Id>> earlier(surface.vertices());
  for (const auto& t : surface.triangles) {
    for (const auto& [a, b] : {std::pair{t[0], t[1]}, {t[0], t[2]}, {t[1], t[2]}})
      before(a, b) ? earlier[b].push_back(a) : earlier[a].push_back(b);
  }
  std::vector<Id> in_order(surface.vertices()), oldest(surface.vertices());
  std::iota(in_order.begin(), in_order.end(), 0);
  std::iota(oldest.begin(), oldest.end(), 0);
  std::sort(in_order.begin(), in_order.end(), before);
  const auto find = [&](Id v) {
    while (oldest[v] != v) v = oldest[v] = oldest[oldest[v]];
    return v;
  };
  GlobalId lasting = 1;
  for (const Id v : in_order) {
    for (const Id other : earlier[v]) {
      Id one = find(v), two = find(other);
      if (one == two) continue;
      if (before(one, two)) std::swap(one, two);
      oldest[one] = two;
      if (one != v) lasting += std::abs(double(values[v]) - values[one]) >= threshold;
    }
  }
  return lasting;
}

TEST_F(Plane600, keeps_the_extrema_of_long_branches_when_simplified) {
  const auto [least, most] = std::minmax_element(values_.begin(), values_.end());
  const double threshold = 0.05 * (*most - *least);
  const auto simplified = simplify_field(
      order_, [&](Id v) { return values_[v]; }, threshold);
  const auto counts = find_critical_points(VertexOrder(mesh_, simplified.rank.data(), simplified.rank.size())).counts;
  EXPECT_EQ(counts[0], lasting_extrema(surface_, values_, threshold, 1));
  EXPECT_EQ(counts[3], lasting_extrema(surface_, values_, threshold, -1));
}

}  // namespace
}  // namespace gale::test
