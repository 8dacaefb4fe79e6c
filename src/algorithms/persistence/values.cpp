#include <algorithm>
#include <cmath>
#include <string>

#include <gale/algorithms/persistence/filtration.hpp>
#include <gale/algorithms/persistence/values.hpp>
#include <gale/base/error.hpp>

namespace gale::detail {

CriticalValues critical_values(const DiscreteGradient& gradient, const std::function<double(Id)>& value) {
  const Id* const input = gradient.mesh().vertex_input().data();
  const CriticalSimplices& critical = gradient.critical();
  CriticalValues values;
  const auto add = [&](int dimension, Id vertex) {
    values[dimension].push_back(value(input[vertex]));
    if (std::isnan(values[dimension].back()))
      throw Error("vertex " + std::to_string(input[vertex]) + " has no field value: it is NaN");
  };
  for (const Id vertex : critical.vertices) add(0, vertex);
  for (const auto& edge : critical.edges) add(1, edge[0]);
  for (const auto& triangle : critical.triangles) add(2, triangle[0]);
  for (const Id tetrahedron : critical.tetrahedra) add(3, from_highest(gradient, tetrahedron)[0]);
  return values;
}

std::vector<PersistencePair> pairs_below(double threshold, int type, const std::vector<PersistencePair>& pairs,
                                         const CriticalValues& values) {
  const auto persistence = [&](const PersistencePair& pair) {
    return persistence_of(values[type][pair.lower], values[type + 1][pair.upper]);
  };
  std::vector<PersistencePair> below;
  std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(below),
               [&](const PersistencePair& pair) { return persistence(pair) < threshold; });
  std::stable_sort(below.begin(), below.end(),
                   [&](const auto& a, const auto& b) { return persistence(a) < persistence(b); });
  return below;
}

}  // namespace gale::detail
