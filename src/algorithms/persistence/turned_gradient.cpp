#include <algorithm>

#include <gale/algorithms/persistence/turned_gradient.hpp>
#include <gale/base/parallel.hpp>

namespace gale::detail {

TurnedForest::TurnedForest(const Array<const Id, HostMemory>& successors)
    : successors_(allocate<Array<Id, HostMemory>>("GALE::turned_successors", successors.extent(0))),
      crosses_(successors.extent(0), 0) {
  parallel_for("GALE::turned_successors", HostExecutionSpace(), successors.extent(0),
               [&](Offset i) { successors_(i) = successors(i); });
}

void TurnedForest::turn(Id side, Id other, Id saddle) {
  Id before = other == no_id ? no_id - 1 : other;  // what is less leaves through the surface
  for (Id at = side; at >= 0;) {
    const Id next = successors_(at);
    successors_(at) = before;
    before = at;
    at = next;
  }
  saddle_from_[side] = saddle;
  crosses_[side] = 1;
}

/// The saddles on a path, and its cells.
std::vector<TurnedForest::Crossing> TurnedForest::crossings(Id from, std::vector<Id>& path) const {
  std::vector<Crossing> found;
  for (Id at = from; at >= 0; at = successors_(at)) {
    path.push_back(at);
    if (!crosses_[at]) continue;
    const auto saddle = saddle_from_.find(at);
    if (saddle != saddle_from_.end()) found.push_back({saddle->second, at});
  }
  return found;
}

std::vector<TurnedForest::Crossing> TurnedForest::cycle(Id side, Id other) const {
  std::vector<Id> one, two;
  auto all = crossings(side, one);
  const auto more = crossings(other, two);
  if (one.back() != two.back()) return {};
  while (!one.empty() && !two.empty() && one.back() == two.back()) {
    one.pop_back();
    two.pop_back();
  }
  // What is crossed from where the paths have met is on neither side of the cycle.
  const std::size_t on_one = one.size(), on_two = two.size();
  std::vector<Crossing> cycle;
  const auto keep = [&](const std::vector<Crossing>& some, const std::vector<Id>& path, std::size_t count) {
    std::size_t k = 0;
    for (const Crossing& crossing : some) {
      while (k < count && path[k] != crossing.from) ++k;
      if (k == count) return;
      cycle.push_back(crossing);
    }
  };
  keep(all, one, on_one);
  keep(more, two, on_two);
  return cycle;
}

void TurnedForest::exchange(Id side, Id other, Id saddle, const Crossing& instead) {
  std::vector<Id> path;
  crossings(side, path);
  if (std::find(path.begin(), path.end(), instead.from) == path.end()) return exchange(other, side, saddle, instead);
  path.resize(std::find(path.begin(), path.end(), instead.from) - path.begin() + 1);
  saddle_from_.erase(instead.from);
  for (std::size_t k = path.size() - 1; k > 0; --k) {
    successors_(path[k]) = path[k - 1];
    const auto crossed = saddle_from_.find(path[k - 1]);
    if (crossed == saddle_from_.end()) continue;
    saddle_from_[path[k]] = crossed->second;
    crosses_[path[k]] = 1;
    saddle_from_.erase(path[k - 1]);
  }
  successors_(side) = other;
  saddle_from_[side] = saddle;
  crosses_[side] = 1;
}

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
