#include <algorithm>
#include <utility>

#include <gale/algorithms/morse_smale/paths_on_ranks.hpp>
#include <gale/algorithms/morse_smale/separatrices_on_ranks.hpp>
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

/// The head of the cells that a rank sends for a piece.
struct PieceHead {
  Id path;
  Offset position, cells;
};

/// The pieces of all paths that start on this rank.
class PathPieces {
 public:
  explicit PathPieces(const PathsOnRanks& paths)
      : ranks_(paths.ranks()), paths_(paths), successors_(paths.simplices().successors().in<HostMemory>()) {}

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
      cells.push_back(paths_.simplices().cell(at));
      at = successors_(at);
    }
  }

  void begin(const std::vector<Id>& starts) {
    for (std::size_t i = 0; i < starts.size(); ++i) {
      const Id end = paths_.end(starts[i]);
      if (paths_.final_stop(end).rank == PathStop::outside) continue;
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
    std::vector<PieceVisit> visits;
    for (const OpenEnd& open : open_) {
      const PathStop& stop = paths_.stops(round)[open.exit];
      if (!stop.is_end())
        visits.push_back({open.rank, open.path, open.position + (Offset(1) << round), stop.rank, stop.id});
    }
    const auto received = sent(visits);
    together(ranks_, [&] {
      for (Offset i = 0; i < received.count(); ++i) {
        const PieceVisit& visit = received.entries(i);
        open(visit.rank, visit.path, visit.position, paths_.end(paths_.simplices().local(visit.simplex)));
      }
    });
  }

  Dealt<PieceVisit> sent(const std::vector<PieceVisit>& visits) const {
    return exchange(ranks_, "GALE::visits",
                    deal<PieceVisit>(
                        ranks_, "GALE::sent_visits", static_cast<Offset>(visits.size()),
                        [&](Id i) { return visits[i].where; }, [&](Id i) { return visits[i]; }));
  }

  /// Each open end has one piece now. Has the ranks that have them send them to where their paths start.
  void send_pieces() {
    std::vector<PieceVisit> visits;
    for (const OpenEnd& open : open_) {
      const PathStop& stop = paths_.stops(0)[open.exit];
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
        const PieceVisit& visit = asked.entries(visits_by_rank.members(i));
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

  const Ranks& ranks_;
  const PathsOnRanks& paths_;
  const Array<const Id, HostMemory>& successors_;
  std::vector<OpenEnd> open_;
  std::vector<std::pair<PieceHead, Offset>> received_;  ///< and where the cells begin among all
  std::vector<PathCell> received_cells_;
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
  Id tetrahedron(const PathSimplices& simplices, const PathCell& cell) {
    if (mesh_.exchange().tetrahedron_of(cell.id) != no_id) return simplices.local(cell.id);
    const auto [number, is_new] = tetrahedra_.insert(static_cast<std::uint64_t>(cell.id));
    if (is_new) {
      number = mesh_.tetrahedra() + static_cast<Id>(beyond_.tetrahedra.size());
      beyond_.tetrahedra.push_back(cell.id);
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
    require_ids("tetrahedra on the paths of a rank",
                Offset(mesh_.tetrahedra()) + static_cast<Offset>(beyond_.tetrahedra.size()));
  }

 private:
  const Mesh& mesh_;
  SimplicesBeyond& beyond_;
  HashTable<Id> vertices_, tetrahedra_;
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
      found.cells.push_back(simplices.are_vertices() ? ids.vertex(cell.id) : ids.tetrahedron(simplices, cell));
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
  const auto tetrahedra = PathSimplices::make(gradient, PathSimplices::Kind::rising_tetrahedra);
  return separatrices_from(*tetrahedra, ascending_starts(gradient.critical()), beyond);
}

}  // namespace gale::detail
