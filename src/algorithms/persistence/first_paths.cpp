#include <algorithm>

#include <gale/algorithms/persistence/first_paths.hpp>

namespace gale::detail {

bool FirstPaths::take(Id lower, Id upper, std::vector<TriangleVertices>& path) const {
  const auto& all = complex_.connectors;
  const auto range = std::equal_range(all.destinations.begin(), all.destinations.end(), upper);
  const auto first = range.first - all.destinations.begin(), end = range.second - all.destinations.begin();
  const auto source = std::find(all.sources.begin() + first, all.sources.begin() + end, lower);
  const auto place = static_cast<Id>(source - all.sources.begin());
  if (place == end) return false;
  const auto& edge = complex_.critical.edges[lower];
  const bool is_as_it_was = !is_turned(edge[0], edge[1]) &&
                            std::none_of(all.first(place), all.last(place) - 1,
                                         [this](const auto& triangle) { return is_turned(triangle[0], triangle[1]); });
  if (is_as_it_was) path.assign(all.first(place), all.last(place));
  return is_as_it_was;
}

}  // namespace gale::detail
