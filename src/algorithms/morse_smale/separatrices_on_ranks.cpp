#include <algorithm>
#include <utility>

#include <gale/algorithms/morse_smale/parts.hpp>
#include <gale/algorithms/morse_smale/paths_on_ranks.hpp>
#include <gale/base/error.hpp>
#include <gale/base/hash_table.hpp>
#include <gale/mesh/exchange/messages.hpp>

namespace gale::detail {

namespace {

/// Paths with all their simplices: the i-th is cells[begin[i]] to cells[begin[i + 1] - 1]; empty if it leaves through
/// the surface.
struct WholePaths {
  std::vector<Offset> begin{0};
  std::vector<PathCell> cells;
};

/// A path of some rank, which begins its `position`-th piece at a simplex; the piece where it starts is its 0th.
struct PieceVisit {
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

/// A cell on a piece of a path, sent to the rank where the path starts.
struct PieceCell {
  Id path;
  Offset position;
  PathCell cell;
};

/// The pieces of all paths that start on this rank.
class PathPieces {
 public:
  explicit PathPieces(const PathsOnRanks& paths)
      : ranks_(paths.ranks()), paths_(paths), successors_(paths.simplices().successors().in<HostMemory>()) {}

  WholePaths gather(const std::vector<Id>& starts) {
    together(ranks_, [&] { begin(starts); });
    for (int round = paths_.rounds(); round > 0; --round) halve(round - 1);
    receive_pieces();
    WholePaths whole;
    together(ranks_, [&] { whole = joined(starts.size()); });
    return whole;
  }

 private:
  /// Calls visit(cell) for the cells of a path from a simplex as far as this rank knows its successors.
  template <class Visit>
  void follow(Id simplex, const Visit& visit) const {
    for (Id at = simplex; at != no_id && successors_(at) != DiscreteGradient::elsewhere; at = successors_(at))
      visit(paths_.simplices().cell(at));
  }

  void begin(const std::vector<Id>& starts) {
    for (std::size_t i = 0; i < starts.size(); ++i) {
      const Id end = paths_.end(starts[i]), path = static_cast<Id>(i);
      if (paths_.final_stop(end).rank == PathStop::outside) continue;
      follow(starts[i], [&](const PathCell& cell) { cells_.push_back({path, 0, cell}); });
      open(ranks_.rank(), path, 0, end);
    }
  }

  void open(int rank, Id path, Offset position, Id end) {
    if (paths_.is_exit(end)) open_.push_back({rank, path, position, paths_.exit_of(end)});
  }

  /// From open ends of 2^(round + 1) pieces to twice as many of 2^round: the second half begins where the path is that
  /// many pieces later.
  void halve(int round) {
    const auto visits = visits_after(round);
    together(ranks_, [&] {
      for (Offset i = 0; i < visits.count(); ++i) {
        const PieceVisit& visit = visits.entries(i);
        open(visit.rank, visit.path, visit.position, paths_.end(paths_.simplices().local(visit.simplex)));
      }
    });
  }

  /// Tells the ranks where the open ends of all are 2^round pieces later, if they go on there, and returns what this
  /// one is told.
  Dealt<PieceVisit> visits_after(int round) const {
    std::vector<PieceVisit> visits;
    for (const OpenEnd& open : open_) {
      const PathStop& stop = paths_.stops(round)[open.exit];
      if (!stop.is_end())
        visits.push_back({open.rank, open.path, open.position + (Offset(1) << round), stop.rank, stop.id});
    }
    return exchange(ranks_, "GALE::visits",
                    deal<PieceVisit>(
                        ranks_, "GALE::sent_visits", static_cast<Offset>(visits.size()),
                        [&](Id i) { return visits[i].where; }, [&](Id i) { return visits[i]; }));
  }

  /// Each open end has one piece now. Has the ranks that have them send them to where their paths start.
  void receive_pieces() {
    const auto asked = visits_after(0);
    std::vector<std::pair<int, PieceCell>> sent;
    together(ranks_, [&] {
      for (Offset i = 0; i < asked.count(); ++i) {
        const PieceVisit& visit = asked.entries(i);
        follow(paths_.simplices().local(visit.simplex), [&](const PathCell& cell) {
          sent.push_back({visit.rank, {visit.path, visit.position, cell}});
        });
      }
      require_ids("cells on the paths of a rank", sent.size());
    });
    const auto received = exchange(ranks_, "GALE::received_cells",
                                   deal<PieceCell>(
                                       ranks_, "GALE::sent_cells", static_cast<Offset>(sent.size()),
                                       [&](Id i) { return sent[i].first; }, [&](Id i) { return sent[i].second; }));
    together(ranks_,
             [&] { cells_.insert(cells_.end(), received.entries.data(), received.entries.data() + received.count()); });
  }

  /// The pieces of each path, one after the other. The cells of a piece came together, in order.
  WholePaths joined(std::size_t count) const {
    const auto key = [&](std::size_t i) { return std::make_pair(cells_[i].path, cells_[i].position); };
    std::vector<std::size_t> pieces;  // where each begins
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (i == 0 || key(i) != key(i - 1)) pieces.push_back(i);
    }
    std::sort(pieces.begin(), pieces.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
    WholePaths whole;
    auto piece = pieces.begin();
    for (std::size_t path = 0; path < count; ++path) {
      for (; piece != pieces.end() && cells_[*piece].path == static_cast<Id>(path); ++piece) {
        for (std::size_t i = *piece; i < cells_.size() && key(i) == key(*piece); ++i)
          whole.cells.push_back(cells_[i].cell);
      }
      whole.begin.push_back(static_cast<Offset>(whole.cells.size()));
    }
    return whole;
  }

  const Ranks& ranks_;
  const PathsOnRanks& paths_;
  const Array<const Id, HostMemory>& successors_;
  std::vector<OpenEnd> open_;
  std::vector<PieceCell> cells_;
};

/// Calls simplices by GALE's ids: those that this rank holds by its own, others after these.
class BeyondIds {
 public:
  BeyondIds(const Mesh& mesh, SimplicesBeyond& beyond) : mesh_(mesh), beyond_(beyond) {
    for (const GlobalId id : beyond.vertices) vertices_.insert(static_cast<std::uint64_t>(id)).first = next_vertex_++;
  }

  Id vertex(GlobalId id) {
    const Id here = mesh_.vertex_of(id);
    if (here != no_id) return mesh_.vertex_internal()(here);
    const auto [number, is_new] = vertices_.insert(static_cast<std::uint64_t>(id));
    if (is_new) {
      number = next_vertex_++;
      beyond_.vertices.push_back(id);
    }
    return number;
  }

  /// `simplices` are those of the paths.
  Id cell_of(const PathSimplices& simplices, const PathCell& cell) {
    if (mesh_.exchange().cell_of(cell.id) != no_id) return simplices.local(cell.id);
    const auto [number, is_new] = cells_.insert(static_cast<std::uint64_t>(cell.id));
    if (is_new) {
      number = mesh_.cells() + static_cast<Id>(beyond_.cells.size());
      beyond_.cells.push_back(cell.id);
      std::array<Id, 4> corners{};
      for (int corner = 0; corner < 4; ++corner) corners[corner] = vertex(cell.corners[corner]);
      beyond_.corners.push_back(corners);
    }
    return number;
  }

  /// Throws gale::Error if ids of 32 bits didn't suffice.
  void require() const {
    require_ids("vertices on the paths of a rank",
                Offset(mesh_.vertices()) + static_cast<Offset>(beyond_.vertices.size()));
    require_ids("cells on the paths of a rank", Offset(mesh_.cells()) + static_cast<Offset>(beyond_.cells.size()));
  }

 private:
  const Mesh& mesh_;
  SimplicesBeyond& beyond_;
  HashTable<Id> vertices_, cells_;
  Id next_vertex_ = mesh_.vertices();
};

Separatrices<Id> separatrices_from(const PathSimplices& simplices, const PathStarts& starts, SimplicesBeyond& beyond) {
  const PathsOnRanks paths(simplices);
  const auto destinations = paths.places_of_ends();
  const WholePaths whole = PathPieces(paths).gather(starts.simplices);
  Separatrices<Id> found;
  together(paths.ranks(), [&] {
    BeyondIds ids(simplices.mesh(), beyond);
    for (std::size_t i = 0; i < starts.simplices.size(); ++i) {
      if (whole.begin[i + 1] == whole.begin[i]) continue;
      found.sources.push_back(starts.sources[i]);
      found.destinations.push_back(destinations(paths.end(starts.simplices[i])));
      found.begin.push_back(whole.begin[i + 1]);
    }
    found.cells.reserve(whole.cells.size());
    for (const PathCell& cell : whole.cells)
      found.cells.push_back(simplices.are_vertices() ? ids.vertex(cell.id) : ids.cell_of(simplices, cell));
    ids.require();
  });
  return found;
}

}  // namespace

Separatrices<Id> descending_separatrices_on_ranks(const DiscreteGradient& gradient, SimplicesBeyond& beyond) {
  const auto vertices = PathSimplices::make(gradient, PathSimplices::Kind::falling_vertices);
  return separatrices_from(*vertices, descending_starts(gradient.mesh(), gradient.critical()), beyond);
}

Separatrices<Id> ascending_separatrices_on_ranks(const DiscreteGradient& gradient, SimplicesBeyond& beyond) {
  const auto cells = PathSimplices::make(gradient, PathSimplices::Kind::rising_cells);
  return separatrices_from(*cells, ascending_starts(gradient.critical()), beyond);
}

}  // namespace gale::detail
