#include <algorithm>
#include <utility>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/distributed/deal.hpp>
#include <gale/distributed/path_pieces.hpp>

namespace gale::detail {

namespace {

/// A path of some rank, which begins its `position`-th piece at a simplex; the piece where it starts is its 0th.
struct Visit {
  int rank;  ///< where it starts
  Id path;   ///< there
  Offset position;
  int where;  ///< the rank that has the piece
  GlobalId simplex;
};

/// A path that goes on through an exit of this rank: the pieces after the `position`-th are to be found.
struct OpenEnd {
  int rank;
  Id path;
  Offset position;
  Id exit;
};

/// The head of the cells that a rank sends for a piece.
struct PieceHead {
  Id path;
  Offset position, cells;
};

class Pieces {
 public:
  Pieces(const Communicator& ranks, const DistributedPaths& paths, const PathShape& shape)
      : ranks_(ranks), paths_(paths), shape_(shape), successors_(paths.simplices().successors->in<HostMemory>()) {}

  WholePaths gather(const std::vector<Id>& starts) {
    together(ranks_, [&] { begin(starts); });
    for (int round = paths_.rounds(); round > 0; --round) halve(round - 1);
    send_pieces();
    WholePaths whole;
    together(ranks_, [&] { whole = joined(starts.size()); });
    return whole;
  }

 private:
  /// The cells of a path from a simplex as far as this rank knows its successors.
  void follow(Id simplex, std::vector<PathCell>& cells) const {
    for (Id at = simplex; at != no_id && successors_(at) != DiscreteGradient::elsewhere;) {
      const Id next = successors_(at);
      cells.push_back(
          {paths_.simplices().global(at), shape_.point_of(at), next == no_id ? PathStep() : shape_.step(at, next)});
      at = next;
    }
  }

  void begin(const std::vector<Id>& starts) {
    for (std::size_t i = 0; i < starts.size(); ++i) {
      const Id end = paths_.end(starts[i]);
      if (paths_.final_stop(end).rank == Stop::outside) continue;
      const auto from = static_cast<Offset>(received_cells_.size());
      follow(starts[i], received_cells_);
      const auto path = static_cast<Id>(i);
      received_.push_back({{path, 0, static_cast<Offset>(received_cells_.size()) - from}, from});
      open(ranks_.rank(), path, 0, end);
    }
  }

  void open(int rank, Id path, Offset position, Id end) {
    if (paths_.is_exit(end)) open_.push_back({rank, path, position, paths_.exit_of(end)});
  }

  /// From open ends of 2^(round + 1) pieces to twice as many of 2^round: the second half begins where the path is that
  /// many pieces later.
  void halve(int round) {
    std::vector<Visit> visits;
    for (const OpenEnd& open : open_) {
      const Stop& stop = paths_.stops(round)[open.exit];
      if (!stop.is_end())
        visits.push_back({open.rank, open.path, open.position + (Offset(1) << round), stop.rank, stop.id});
    }
    const auto received = sent(visits);
    together(ranks_, [&] {
      for (Offset i = 0; i < received.count(); ++i) {
        const Visit& visit = received.entries(i);
        open(visit.rank, visit.path, visit.position, paths_.end(paths_.simplices().local(visit.simplex)));
      }
    });
  }

  Dealt<Visit> sent(const std::vector<Visit>& visits) const {
    return exchange(ranks_, "GALE::visits",
                    deal<Visit>(
                        ranks_, "GALE::sent_visits", static_cast<Offset>(visits.size()),
                        [&](Id i) { return visits[i].where; }, [&](Id i) { return visits[i]; }));
  }

  /// Each open end has one piece now. Has the ranks that have them send them to where their paths start.
  void send_pieces() {
    std::vector<Visit> visits;
    for (const OpenEnd& open : open_) {
      const Stop& stop = paths_.stops(0)[open.exit];
      visits.push_back({open.rank, open.path, open.position + 1, stop.rank, stop.id});
    }
    const auto asked = sent(visits);
    std::vector<PathCell> cells;
    std::vector<std::int64_t> cells_to(ranks_.size(), 0);
    Dealt<PieceHead> heads;
    Dealt<PathCell> bodies;
    together(ranks_, [&] {
      const ByRank visits_by_rank =
          by_rank(ranks_.size(), asked.count(), [&](Id i, const auto& visit) { visit(asked.entries(i).rank); });
      heads = {allocate<Array<PieceHead, HostMemory>>("GALE::piece_heads", asked.count()), visits_by_rank.begin};
      for (Offset i = 0; i < asked.count(); ++i) {
        const Visit& visit = asked.entries(visits_by_rank.members(i));
        const std::size_t before = cells.size();
        follow(paths_.simplices().local(visit.simplex), cells);
        heads.entries(i) = {visit.path, visit.position, static_cast<Offset>(cells.size() - before)};
        cells_to[visit.rank] += heads.entries(i).cells;
      }
      bodies = dealt<PathCell>("GALE::piece_cells", cells_to);
      std::copy(cells.begin(), cells.end(), bodies.entries.data());
    });
    const auto received_heads = exchange(ranks_, "GALE::received_heads", heads);
    const auto received_bodies = exchange(ranks_, "GALE::received_cells", bodies);
    together(ranks_, [&] {
      auto from = static_cast<Offset>(received_cells_.size());
      received_cells_.insert(received_cells_.end(), received_bodies.entries.data(),
                             received_bodies.entries.data() + received_bodies.count());
      for (Offset i = 0; i < received_heads.count(); ++i) {
        received_.push_back({received_heads.entries(i), from});
        from += received_heads.entries(i).cells;
      }
    });
  }

  /// The pieces of each path, one after the other.
  WholePaths joined(std::size_t count) {
    std::sort(received_.begin(), received_.end(), [](const auto& a, const auto& b) {
      return std::make_pair(a.first.path, a.first.position) < std::make_pair(b.first.path, b.first.position);
    });
    WholePaths whole;
    auto next = received_.begin();
    for (std::size_t path = 0; path < count; ++path) {
      for (; next != received_.end() && next->first.path == static_cast<Id>(path); ++next) {
        const auto from = received_cells_.begin() + next->second;
        whole.cells.insert(whole.cells.end(), from, from + next->first.cells);
      }
      whole.begin.push_back(static_cast<Offset>(whole.cells.size()));
    }
    return whole;
  }

  const Communicator& ranks_;
  const DistributedPaths& paths_;
  const PathShape& shape_;
  const Array<const Id, HostMemory>& successors_;
  std::vector<OpenEnd> open_;
  std::vector<std::pair<PieceHead, Offset>> received_;  ///< and where the cells begin among all
  std::vector<PathCell> received_cells_;
};

}  // namespace

WholePaths whole_paths(const Communicator& ranks, const DistributedPaths& paths, const std::vector<Id>& starts,
                       const PathShape& shape) {
  return Pieces(ranks, paths, shape).gather(starts);
}

}  // namespace gale::detail
