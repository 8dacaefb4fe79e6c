#include <algorithm>
#include <utility>

#include <gale/algorithms/persistence/saddle_graph.hpp>

namespace gale::detail {

SaddleGraph::SaddleGraph(const Separatrices<TriangleVertices>& connectors, const std::vector<char>& lower,
                         const std::vector<char>& upper)
    : up_(lower.size()), down_(upper.size()) {
  for (Id i = 0; i < connectors.count(); ++i) {
    const Id source = connectors.sources[i], destination = connectors.destinations[i];
    if (!lower[source] || !upper[destination]) continue;
    up_[source].emplace(destination, connectors.is_only[i] ? one : several);
    down_[destination].insert(source);
  }
}

void SaddleGraph::cancel(Id lower, Id upper, const std::function<void(Id, Id)>& changed) {
  const auto above = std::exchange(up_[lower], {});
  const auto below = std::exchange(down_[upper], {});
  for (const auto& to : above) down_[to.first].erase(lower);
  for (const Id from : below) {
    if (from == lower) continue;
    const int paths_below = up_[from].at(upper);
    up_[from].erase(upper);
    for (const auto& [to, paths_above] : above) {
      if (to == upper) continue;
      int& paths = up_[from][to];
      paths = std::min<int>(several, paths + paths_below * paths_above);
      down_[to].insert(from);
      changed(from, to);
    }
  }
}

void SaddleGraph::replace(Id upper, const std::vector<std::pair<Id, int>>& paths) {
  for (const Id lower : down_[upper]) up_[lower].erase(upper);
  down_[upper].clear();
  for (const auto& [lower, count] : paths) {
    up_[lower][upper] = count;
    down_[upper].insert(lower);
  }
}

}  // namespace gale::detail
