#include <algorithm>

#include <gale/algorithms/persistence/first_paths.hpp>

namespace gale::detail {

FirstPaths::FirstPaths(const MorseSmaleComplex& complex, const TurnedEdges& turned)
    : complex_(complex), turned_(turned), begin_(complex.critical.triangles.size() + 1, 0) {
  for (const Id upper : complex.connectors.destinations) ++begin_[upper + 1];
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
}

bool FirstPaths::take(Id lower, Id upper, std::vector<TriangleVertices>& path) const {
  const auto& all = complex_.connectors;
  const Id end = begin_[upper + 1];
  const auto source = std::find(all.sources.begin() + begin_[upper], all.sources.begin() + end, lower);
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
