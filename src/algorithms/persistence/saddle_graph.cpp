#include <algorithm>

#include <gale/algorithms/persistence/saddle_graph.hpp>

namespace gale::detail {

namespace {

bool is_before(const std::pair<Id, int>& paths, Id upper) { return paths.first < upper; }

auto place_of(SaddleGraph::Above& above, Id upper) {
  return std::lower_bound(above.begin(), above.end(), upper, is_before);
}

void erase(std::vector<Id>& ids, Id id) {
  const auto at = std::lower_bound(ids.begin(), ids.end(), id);
  if (at != ids.end() && *at == id) ids.erase(at);
}

void insert(std::vector<Id>& ids, Id id) {
  const auto at = std::lower_bound(ids.begin(), ids.end(), id);
  if (at == ids.end() || *at != id) ids.insert(at, id);
}

void erase(SaddleGraph::Above& above, Id upper) {
  const auto at = place_of(above, upper);
  if (at != above.end() && at->first == upper) above.erase(at);
}

/// The number of paths to a 2-saddle, to be set; 0 at first.
int& paths_in(SaddleGraph::Above& above, Id upper) {
  const auto at = place_of(above, upper);
  return at != above.end() && at->first == upper ? at->second : above.insert(at, {upper, 0})->second;
}

}  // namespace

SaddleGraph::SaddleGraph(const Separatrices<TriangleVertices>& connectors, const std::vector<char>& lower,
                         const std::vector<char>& upper)
    : up_(lower.size()), down_(upper.size()) {
  for (Id i = 0; i < connectors.count(); ++i) {
    const Id source = connectors.sources[i], destination = connectors.destinations[i];
    if (!lower[source] || !upper[destination]) continue;
    paths_in(up_[source], destination) = connectors.is_only[i] ? one : several;
    insert(down_[destination], source);
  }
}

int SaddleGraph::paths(Id lower, Id upper) const {
  const auto at = std::lower_bound(up_[lower].begin(), up_[lower].end(), upper, is_before);
  return at == up_[lower].end() || at->first != upper ? 0 : at->second;
}

void SaddleGraph::cancel(Id lower, Id upper, const std::function<void(Id, Id)>& changed) {
  const auto above = std::exchange(up_[lower], {});
  const auto below = std::exchange(down_[upper], {});
  for (const auto& to : above) erase(down_[to.first], lower);
  for (const Id from : below) {
    if (from == lower) continue;
    const int paths_below = paths(from, upper);
    erase(up_[from], upper);
    for (const auto& [to, paths_above] : above) {
      if (to == upper) continue;
      int& all = paths_in(up_[from], to);
      all = std::min<int>(several, all + paths_below * paths_above);
      insert(down_[to], from);
      changed(from, to);
    }
  }
}

void SaddleGraph::replace(Id upper, const std::vector<std::pair<Id, int>>& paths) {
  for (const Id lower : down_[upper]) erase(up_[lower], upper);
  down_[upper].clear();
  for (const auto& [lower, count] : paths) {
    paths_in(up_[lower], upper) = count;
    insert(down_[upper], lower);
  }
}

}  // namespace gale::detail
