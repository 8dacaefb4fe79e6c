#include <algorithm>
#include <memory>
#include <set>
#include <tuple>

#include <gale/algorithms/morse_smale/descending_wall.hpp>
#include <gale/algorithms/persistence/cancellations.hpp>
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
            bool want_joined, TurnedForest& minima, TurnedEdges& turned)
      : complex_(complex),
        critical_(complex.gradient.critical()),
        places_(places),
        doomed_(doomed),
        want_joined_(want_joined),
        minima_(minima),
        turned_(turned),
        first_paths_(complex, turned),
        lower_(marks(critical_.edges.size(), doomed.pairs, &PersistencePair::lower)),
        upper_(marks(critical_.triangles.size(), doomed.pairs, &PersistencePair::upper)),
        minimum_below_(doomed.minimum_below),
        graph_(complex.connectors, lower_, upper_),
        is_known_(critical_.triangles.size(), 0),
        may_exchange_(critical_.triangles.size(), 0),
        walls_(std::max(host_threads(), 1)),
        joined_(want_joined ? critical_.edges.size() : 0) {}

  CancelledSaddles run() {
    for (const auto& [lower, upper] : doomed_.pairs) {
      if (lower_[lower] && upper_[upper] && graph_.paths(lower, upper) == SaddleGraph::several) {
        // Walls grow with each cancellation: now this one is smaller than it will ever be again.
        graph_.replace(upper, count_paths(upper, wall_of(0)));
      }
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
    return {std::move(cancelled_), std::move(exchanged_), std::move(joined_), kept()};
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
    const double low = doomed_.lower[lower], high = doomed_.upper[upper];
    if (is_small(lower, upper)) offered_.insert({low == high ? 0 : high - low, lower, upper});
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
    stop_if_asked();
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
    if (want_joined_ || !first_paths_.take(lower, upper, path_)) find_path(lower, upper, from);
    DescendingWall::Edge at = from;
    for (const TriangleVertices& triangle : path_) {
      const auto third = std::find_if(triangle.begin(), triangle.end(),
                                      [&](Id vertex) { return vertex != at.high && vertex != at.low; });
      turned_.set(at.high, at.low, *third);
      at = {triangle[0], triangle[1]};
    }
  }

  void find_path(Id lower, Id upper, const DescendingWall::Edge& from) {
    const TriangleVertices& to = critical_.triangles[upper];
    // Most paths stay above their lower end.
    DescendingWall& wall = wall_of(0);
    if (want_joined_) {
      wall.follow(to);
      // One that was cancelled with a minimum may come back for another.
      for (const auto* const rim : {&wall.critical_edges(), &wall.cancelled_edges()}) {
        for (const auto& met : *rim) {
          const Id joined = places_.of_edge(met.high, met.low);
          if (joined != lower) joined_[joined].push_back(lower);
        }
      }
    } else if (!wall.follow_to(to, from, true)) {
      wall.follow_to(to, from, false);
    }
    path_.clear();
    wall.append_path(from, path_);
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
    if (!wall) wall = std::make_unique<DescendingWall>(ground_of(complex_.gradient), &turned_);
    return *wall;
  }

  /// The paths to a 2-saddle from the 1-saddles that are left to cancel, by its wall.
  std::vector<std::pair<Id, int>> count_paths(Id upper, DescendingWall& wall) const {
    std::vector<std::pair<Id, int>> paths;
    wall.follow(critical_.triangles[upper]);
    wall.count_paths();
    for (const auto& edge : wall.critical_edges()) {
      const Id lower = places_.of_edge(edge.high, edge.low);
      if (lower_[lower]) paths.push_back({lower, wall.paths_from(edge)});
    }
    return paths;
  }

  /// Counts the paths from the 2-saddles that are left, and that weren't counted since they changed, by their walls.
  void look_again() {
    looked_ = true;
    const auto exchanges = possible_exchanges();
    std::vector<Id> uppers = left(upper_);
    uppers.erase(std::remove_if(uppers.begin(), uppers.end(), [this](Id upper) { return is_known_[upper] != 0; }),
                 uppers.end());
    std::vector<std::vector<std::pair<Id, int>>> paths(uppers.size());
    in_turns(static_cast<int>(walls_.size()), static_cast<std::int64_t>(uppers.size()),
             [&](int thread, std::int64_t i) {
               DescendingWall& wall = wall_of(thread);
               paths[i] = count_paths(uppers[i], wall);
               may_exchange_[uppers[i]] = best_exchange(exchanges, uppers[i], wall) != nullptr;
             });
    for (std::size_t i = 0; i < uppers.size(); ++i) {
      is_known_[uppers[i]] = 1;
      graph_.replace(uppers[i], paths[i]);
      for (const auto& [lower, count] : paths[i]) {
        if (count == SaddleGraph::one) offer(lower, uppers[i]);
      }
    }
  }

  /// Where a 1-saddle is left, another one may take its place: one that was cancelled with a minimum, and lies on a
  /// cycle of paths to minima with it.
  struct SaddleExchange {
    Id lower;
    TurnedForest::Crossing instead;
  };

  std::vector<SaddleExchange> possible_exchanges() const {
    std::vector<SaddleExchange> possible;
    for (const Id lower : left(lower_)) {
      stop_if_asked();
      add_exchanges(lower, possible);
    }
    return possible;
  }

  void add_exchanges(Id lower, std::vector<SaddleExchange>& possible) const {
    const auto& edge = critical_.edges[lower];
    for (const auto& crossing : minima_.cycle(edge[0], edge[1])) {
      if (doomed_.lower[lower] - minimum_below_[crossing.saddle] < doomed_.threshold)
        possible.push_back({lower, crossing});
    }
  }

  /// Whether a cycle still is as it was when an exchange was found: others change cycles.
  bool is_possible(const SaddleExchange& exchange) const {
    std::vector<SaddleExchange> possible;
    if (lower_[exchange.lower]) add_exchanges(exchange.lower, possible);
    return std::any_of(possible.begin(), possible.end(), [&](const SaddleExchange& other) {
      return other.instead.saddle == exchange.instead.saddle && other.instead.from == exchange.instead.from;
    });
  }

  /// The exchange with the highest other 1-saddle among those with one path to the 2-saddle that has this wall.
  const SaddleExchange* best_exchange(const std::vector<SaddleExchange>& possible, Id upper,
                                      const DescendingWall& wall) const {
    const SaddleExchange* best = nullptr;
    for (const SaddleExchange& exchange : possible) {
      const Id saddle = exchange.instead.saddle;
      if (!lower_[exchange.lower] || !is_small(saddle, upper)) continue;
      if (best != nullptr && doomed_.lower[saddle] <= doomed_.lower[best->instead.saddle]) continue;
      const auto& edge = critical_.edges[saddle];
      if (wall.paths_from({edge[0], edge[1]}) == 1) best = &exchange;
    }
    return best;
  }

  /// A pair is kept if one of the two is: as many of one kind as of the other are.
  KeptBelow kept() const {
    KeptBelow kept;
    for (const PersistencePair& pair : doomed_.pairs) {
      if (!upper_[pair.upper]) continue;
      const bool may_have_several = lower_[pair.lower] && graph_.paths(pair.lower, pair.upper) == SaddleGraph::several;
      ++(may_have_several ? kept.several_paths : kept.no_path);
    }
    return kept;
  }

  /// Exchanges 1-saddles that are left for such as can be cancelled with a 2-saddle that is left.
  void exchange_saddles() {
    const auto possible = possible_exchanges();
    for (const Id upper : left(upper_)) {
      if (!may_exchange_[upper]) continue;
      DescendingWall& wall = wall_of(0);
      wall.follow(critical_.triangles[upper]);
      wall.count_paths();
      const SaddleExchange* const best = best_exchange(possible, upper, wall);
      if (best != nullptr && is_possible(*best)) exchange(*best, upper);
    }
  }

  void exchange(const SaddleExchange& exchange, Id upper) {
    const Id lower = exchange.lower, instead = exchange.instead.saddle;
    const auto &edge = critical_.edges[lower], &other = critical_.edges[instead];
    minima_.exchange(edge[0], edge[1], lower, exchange.instead);
    minimum_below_[lower] = minimum_below_[instead];
    turned_.set(edge[0], edge[1], TurnedEdges::with_vertex);
    turned_.set(other[0], other[1], no_id);
    turn_path(instead, upper);
    lower_[lower] = upper_[upper] = 0;
    cancelled_.push_back({instead, upper});
    exchanged_.push_back({lower, instead});
  }

  const MorseSmaleComplex& complex_;
  const CriticalSimplices& critical_;
  const CriticalPlaces& places_;
  const DoomedSaddles& doomed_;
  bool want_joined_;
  TurnedForest& minima_;
  TurnedEdges& turned_;
  FirstPaths first_paths_;
  std::vector<char> lower_, upper_;    ///< whether a saddle is left to cancel
  std::vector<double> minimum_below_;  ///< of the minimum that a 1-saddle is cancelled with
  SaddleGraph graph_;
  std::vector<char> is_known_;      ///< of a 2-saddle: whether its paths were counted since they changed
  std::vector<char> may_exchange_;  ///< of a 2-saddle: whether an exchange would have set one free for it
  std::vector<std::unique_ptr<DescendingWall>> walls_;  ///< one for each thread
  std::set<std::tuple<double, Id, Id>> offered_;        ///< difference, lower, upper
  std::vector<TriangleVertices> path_;
  std::vector<PersistencePair> cancelled_;
  std::vector<std::pair<Id, Id>> exchanged_;
  std::vector<std::vector<Id>> joined_;
  bool is_second_pass_ = false, looked_ = false;
};

}  // namespace

CancelledSaddles cancel_saddles(const MorseSmaleComplex& complex, const CriticalPlaces& places,
                                const DoomedSaddles& doomed, bool want_joined, TurnedForest& minima,
                                TurnedEdges& turned) {
  return Canceller(complex, places, doomed, want_joined, minima, turned).run();
}

}  // namespace gale::detail
