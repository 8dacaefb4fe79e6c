#include <algorithm>

#include <gale/algorithms/order/require.hpp>
#include <gale/algorithms/persistence/pairs.hpp>
#include <gale/base/sort.hpp>

namespace gale::detail {

namespace {

/// Sorts `count` simplices by vertices_of(place), which has them from the highest to the lowest.
template <class VerticesOf>
void sort_places(const std::uint64_t* keys, std::size_t count, const VerticesOf& vertices_of, std::vector<Id>& by_rank,
                 std::vector<Id>& rank) {
  struct Keyed {
    std::uint64_t highest;
    Id place;
  };
  std::vector<Keyed> keyed(count);
  parallel_for("GALE::filtration_keys", HostExecutionSpace(), count, [&](Offset i) {
    keyed[i] = {keys[vertices_of(i)[0]], static_cast<Id>(i)};
  });
  const auto is_before = [&](const Keyed& a, const Keyed& b) {
    if (a.highest != b.highest) return a.highest < b.highest;
    const auto of_a = vertices_of(a.place), of_b = vertices_of(b.place);
    for (std::size_t i = 1; i < of_a.size(); ++i) {
      if (of_a[i] != of_b[i]) return keys[of_a[i]] < keys[of_b[i]];
    }
    return false;
  };
  parallel_sort("GALE::sort_filtration", keyed.begin(), keyed.end(), is_before);
  by_rank.resize(count);
  rank.resize(count);
  parallel_for("GALE::filtration", HostExecutionSpace(), count, [&](Offset i) {
    by_rank[i] = keyed[i].place;
    rank[keyed[i].place] = static_cast<Id>(i);
  });
}

/// The first so many corners of a cell, from the highest to the lowest.
template <int count>
std::array<Id, count> from_highest(const std::uint64_t* keys, const Quad& corners) {
  std::array<Id, count> vertices;
  for (int i = 0; i < count; ++i) vertices[i] = corners[i];
  std::sort(vertices.begin(), vertices.end(), [&](Id a, Id b) { return keys[a] > keys[b]; });
  return vertices;
}

}  // namespace

Id highest_corner(const DiscreteGradient& gradient, Id cell) {
  const Quad corners = gradient.mesh().cell_reader()(cell);
  const std::uint64_t* const keys = gradient.order().keys();
  Id highest = corners.a;
  for (int i = 1; i <= gradient.mesh().dimension(); ++i) {
    if (keys[corners[i]] > keys[highest]) highest = corners[i];
  }
  return highest;
}

Filtration filtration_of(const DiscreteGradient& gradient, int threads) {
  const ThreadLimit limit(threads);
  const CriticalSimplices& critical = gradient.critical();
  const std::uint64_t* const keys = gradient.order().keys();
  const CellReader corners = gradient.mesh().cell_reader();
  Filtration filtration;
  const auto sort = [&](int dimension, const auto& vertices_of) {
    sort_places(keys, critical.counts()[dimension], vertices_of, filtration.by_rank[dimension],
                filtration.rank[dimension]);
  };
  sort(0, [&](Offset i) { return std::array<Id, 1>{critical.vertices[i]}; });
  sort(1, [&](Offset i) { return critical.edges[i]; });
  if (critical.dimension == 2) {
    sort(2, [&](Offset i) { return from_highest<3>(keys, corners(critical.cells[i])); });
  } else {
    sort(2, [&](Offset i) { return critical.triangles[i]; });
    sort(3, [&](Offset i) { return from_highest<4>(keys, corners(critical.cells[i])); });
  }
  return filtration;
}

CriticalValues critical_values(const DiscreteGradient& gradient, const std::function<double(Id)>& value) {
  const OtherIds input = gradient.mesh().vertices_in_input();
  const CriticalSimplices& critical = gradient.critical();
  CriticalValues values;
  const auto add = [&](int dimension, Id vertex) {
    const Id from = input[vertex];
    values[dimension].push_back(known_value(value(from), gradient.mesh().vertex_id(from)));
  };
  for (const Id vertex : critical.vertices) add(0, vertex);
  for (const auto& edge : critical.edges) add(1, edge[0]);
  for (const auto& triangle : critical.triangles) add(2, triangle[0]);
  for (const Id cell : critical.cells) add(critical.dimension, highest_corner(gradient, cell));
  return values;
}

std::vector<PersistencePair> pairs_below(double threshold, int type, const std::vector<PersistencePair>& pairs,
                                         const CriticalValues& values) {
  const auto persistence = [&](const PersistencePair& pair) {
    const double low = values[type][pair.lower], high = values[type + 1][pair.upper];
    return low == high ? 0 : high - low;  // which may be infinite
  };
  std::vector<PersistencePair> below;
  std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(below),
               [&](const PersistencePair& pair) { return persistence(pair) < threshold; });
  std::stable_sort(below.begin(), below.end(),
                   [&](const auto& a, const auto& b) { return persistence(a) < persistence(b); });
  return below;
}

}  // namespace gale::detail

namespace gale {

HighestVertices highest_vertices(const DiscreteGradient& gradient) {
  const OtherIds input = gradient.mesh().vertices_in_input();
  const CriticalSimplices& critical = gradient.critical();
  HighestVertices highest;
  highest.dimension = critical.dimension;
  auto& of = highest.of_critical;
  for (const Id vertex : critical.vertices) of[0].push_back(input[vertex]);
  for (const auto& edge : critical.edges) of[1].push_back(input[edge[0]]);
  for (const auto& triangle : critical.triangles) of[2].push_back(input[triangle[0]]);
  for (const Id cell : critical.cells) of[critical.dimension].push_back(input[detail::highest_corner(gradient, cell)]);
  const Id of_all = gradient.order().highest({0, gradient.mesh().vertices()});
  if (of_all != no_id) highest.of_all = input[of_all];
  return highest;
}

}  // namespace gale
