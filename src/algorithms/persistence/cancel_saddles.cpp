#include <algorithm>
#include <memory>
#include <set>
#include <tuple>

#include <gale/algorithms/morse_smale/descending_wall.hpp>
#include <gale/algorithms/persistence/cancel_saddles.hpp>
#include <gale/algorithms/persistence/saddle_graph.hpp>
#include <gale/base/threads.hpp>

namespace gale::detail {

namespace {

std::vector<char> marks(std::size_t count, const std::vector<PersistencePair>& pairs, Id PersistencePair::*member) {
  std::vector<char> marks(count, 0);
  for (const PersistencePair& pair : pairs) marks[pair.*member] = 1;
  return marks;
}

class Canceller {
 public:
  Canceller(const MorseSmaleComplex& complex, const CriticalPlaces& places, const DoomedSaddles& doomed,
            TurnedForest& minima, TurnedEdges& turned)
      : complex_(complex),
        critical_(complex.gradient.critical()),
        places_(places),
        doomed_(doomed),
        minima_(minima),
        turned_(turned),
        lower_(marks(critical_.edges.size(), doomed.pairs, &PersistencePair::lower)),
        upper_(marks(critical_.triangles.size(), doomed.pairs, &PersistencePair::upper)),
        graph_(complex.connectors, lower_, upper_),
        is_known_(critical_.triangles.size(), 0),
        walls_(std::max(host_threads(), 1)) {}

  CancelledSaddles run() {
    for (const auto& [lower, upper] : doomed_.pairs) {
      if (may_cancel(lower, upper)) cancel(lower, upper);
    }
    for (const PersistencePair& pair : doomed_.pairs) {
      if (!lower_[pair.lower]) continue;
      for (const auto& [upper, paths] : graph_.above(pair.lower)) {
        if (paths == SaddleGraph::one) offer(pair.lower, upper);
      }
    }
    is_second_pass_ = true;
    while (cancel_offered()) look_again();
    exchange_saddles();
    return {std::move(cancelled_), std::move(exchanged_)};
  }

 private:
  /// Are both there, with one path and a difference below the threshold?
  bool may_cancel(Id lower, Id upper) const {
    return lower_[lower] && upper_[upper] && graph_.paths(lower, upper) == SaddleGraph::one && is_small(lower, upper);
  }

  bool is_small(Id lower, Id upper) const {
    return doomed_.lower[lower] == doomed_.upper[upper]
               ? doomed_.threshold > 0
               : doomed_.lower[lower] < doomed_.upper[upper] &&
                     doomed_.upper[upper] - doomed_.lower[lower] < doomed_.threshold;
  }

  void offer(Id lower, Id upper) {
    if (is_small(lower, upper)) offered_.insert({doomed_.upper[upper] - doomed_.lower[lower], lower, upper});
  }

  /// Whether it cancelled any.
  bool cancel_offered() {
    const std::size_t before = cancelled_.size();
    while (!offered_.empty()) {
      const auto [difference, lower, upper] = *offered_.begin();
      offered_.erase(offered_.begin());
      if (may_cancel(lower, upper)) cancel(lower, upper);
    }
    return cancelled_.size() != before || !looked_;
  }

  void cancel(Id lower, Id upper) {
    turn_path(lower, upper);
    lower_[lower] = upper_[upper] = 0;
    graph_.cancel(lower, upper, [this](Id from, Id to) {
      is_known_[to] = 0;
      if (is_second_pass_) offer(from, to);
    });
    cancelled_.push_back({lower, upper});
  }

  /// Pairs each edge of the only path with the triangle above it.
  void turn_path(Id lower, Id upper) {
    const auto& edge = critical_.edges[lower];
    const DescendingWall::Edge from{edge[0], edge[1]};
    const TriangleVertices& to = critical_.triangles[upper];
    // Most paths stay above their lower end.
    DescendingWall& wall = wall_of(0);
    if (!wall.follow_to(to, from, true)) wall.follow_to(to, from, false);
    path_.clear();
    wall.append_path(from, path_);
    DescendingWall::Edge at = from;
    for (const TriangleVertices& triangle : path_) {
      const auto third = std::find_if(triangle.begin(), triangle.end(),
                                      [&](Id vertex) { return vertex != at.high && vertex != at.low; });
      turned_.set(at.high, at.low, *third);
      at = {triangle[0], triangle[1]};
    }
  }

  std::vector<Id> left(const std::vector<char>& is_left) const {
    std::vector<Id> left;
    for (std::size_t i = 0; i < is_left.size(); ++i) {
      if (is_left[i]) left.push_back(static_cast<Id>(i));
    }
    return left;
  }

  DescendingWall& wall_of(int thread) {
    auto& wall = walls_[thread];
    if (!wall) wall = std::make_unique<DescendingWall>(complex_.gradient, &turned_);
    return *wall;
  }

  /// Counts the paths from the 2-saddles that are left, and that weren't counted since they changed, by their walls.
  void look_again() {
    looked_ = true;
    const std::vector<Id> uppers = left(upper_);
    std::vector<std::vector<std::pair<Id, int>>> paths(uppers.size());
    in_turns(static_cast<int>(walls_.size()), static_cast<std::int64_t>(uppers.size()), [&](int thread, std::int64_t i) {
      if (is_known_[uppers[i]]) return;
      DescendingWall& wall = wall_of(thread);
      wall.follow(critical_.triangles[uppers[i]]);
      for (const auto& edge : wall.critical_edges()) {
        const Id lower = places_.of_edge(edge.high, edge.low);
        if (lower_[lower]) paths[i].push_back({lower, wall.paths_from(edge)});
      }
    });
    for (std::size_t i = 0; i < uppers.size(); ++i) {
      if (is_known_[uppers[i]]) continue;
      is_known_[uppers[i]] = 1;
      graph_.replace(uppers[i], paths[i]);
      for (const auto& [lower, count] : paths[i]) {
        if (count == SaddleGraph::one) offer(lower, uppers[i]);
      }
    }
  }

  /// Where a 1-saddle is left, another one may take its place: one that was cancelled with a minimum, and lies on a
  /// cycle of paths to minima with it.
  struct Exchange {
    Id lower, instead;
    TurnedForest::Crossing crossing;
  };

  std::vector<Exchange> possible_exchanges() const {
    std::vector<Exchange> possible;
    for (const Id lower : left(lower_)) {
      const auto& edge = critical_.edges[lower];
      for (const auto& crossing : minima_.cycle(edge[0], edge[1])) {
        if (doomed_.lower[lower] - doomed_.minimum_below[crossing.saddle] < doomed_.threshold)
          possible.push_back({lower, crossing.saddle, crossing});
      }
    }
    return possible;
  }

  /// Exchanges 1-saddles that are left for such as can be cancelled with a 2-saddle that is left.
  void exchange_saddles() {
    std::vector<Exchange> possible = possible_exchanges();
    for (const Id upper : left(upper_)) {
      if (possible.empty()) return;
      DescendingWall& wall = wall_of(0);
      wall.follow(critical_.triangles[upper]);
      const Exchange* best = nullptr;
      for (const Exchange& exchange : possible) {
        const auto& edge = critical_.edges[exchange.instead];
        if (!is_small(exchange.instead, upper) || wall.paths_from({edge[0], edge[1]}) != 1) continue;
        if (best == nullptr || doomed_.lower[exchange.instead] > doomed_.lower[best->instead]) best = &exchange;
      }
      if (best == nullptr) continue;
      const Id instead = best->instead;
      const auto &edge = critical_.edges[best->lower], &other = critical_.edges[instead];
      minima_.exchange(edge[0], edge[1], best->lower, best->crossing);
      turned_.set(edge[0], edge[1], TurnedEdges::with_vertex);
      turned_.set(other[0], other[1], no_id);
      turn_path(instead, upper);
      lower_[best->lower] = upper_[upper] = 0;
      cancelled_.push_back({instead, upper});
      exchanged_.push_back({best->lower, instead});
      possible = possible_exchanges();
    }
  }

  const MorseSmaleComplex& complex_;
  const CriticalSimplices& critical_;
  const CriticalPlaces& places_;
  const DoomedSaddles& doomed_;
  TurnedForest& minima_;
  TurnedEdges& turned_;
  std::vector<char> lower_, upper_;  ///< those that are left to cancel
  SaddleGraph graph_;
  std::vector<char> is_known_;  ///< of a 2-saddle: whether its paths were counted since they changed
  std::vector<std::unique_ptr<DescendingWall>> walls_;  ///< one for each thread
  std::set<std::tuple<double, Id, Id>> offered_;  ///< difference, lower, upper
  std::vector<TriangleVertices> path_;
  std::vector<PersistencePair> cancelled_;
  std::vector<std::pair<Id, Id>> exchanged_;
  bool is_second_pass_ = false, looked_ = false;
};

}  // namespace

CancelledSaddles cancel_saddles(const MorseSmaleComplex& complex, const CriticalPlaces& places,
                                const DoomedSaddles& doomed, TurnedForest& minima, TurnedEdges& turned) {
  return Canceller(complex, places, doomed, minima, turned).run();
}

}  // namespace gale::detail
