#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <gale/algorithms/excerpt/gathering.hpp>
#include <gale/algorithms/gradient/follow_each_path.hpp>
#include <gale/algorithms/morse_smale/paths_on_ranks.hpp>
#include <gale/algorithms/persistence/ends_on_ranks.hpp>
#include <gale/mesh/exchange/messages.hpp>

namespace gale::detail {

namespace {

/// Where a path ends, or which rank follows it on from where.
struct Stop {
  int rank = SentEnd::outside;
  Id place = no_id;
  GlobalId next = -1;
};

/// Paths of one kind from some simplices, each followed as far as it has been.
class Followers {
 public:
  /// `places` has those of this rank's critical simplices. Refers to both.
  Followers(const PathSimplices& simplices, const CriticalPlaces& places) : simplices_(simplices), places_(places) {}

  /// Follows the paths from these simplices (GALE's ids) in this rank's part.
  void set_out(const std::vector<Id>& starts) {
    stops_.resize(starts.size());
    follow(
        static_cast<Offset>(starts.size()), [&](Offset i) { return starts[i]; }, stops_.data());
    open_ = collected<Id>("GALE::open_paths", stops_.size(), [&](Offset i, const auto& add) {
      if (stops_[i].next >= 0) add(static_cast<Id>(i));
    });
  }

  /// How many paths others have to follow, and where the i-th of these is.
  Offset open() const { return static_cast<Offset>(open_.size()); }
  const Stop& open_stop(Offset i) const { return stops_[open_[i]]; }

  /// Follows paths of other ranks that have come to some simplices, the i-th from global(i) on.
  template <class Global>
  std::vector<Stop> follow_others(Offset count, const Global& global) const {
    std::vector<Stop> found(count);
    follow(
        count, [&](Offset i) { return simplices_.local(global(i)); }, found.data());
    return found;
  }

  /// Takes to where others have followed the open ones: the i-th to stop(i).
  template <class StopOf>
  void take(const StopOf& stop) {
    parallel_for("GALE::found_ends", HostExecutionSpace(), open(), [&](Offset i) { stops_[open_[i]] = stop(i); });
    open_ = collected<Id>("GALE::open_paths", open(), [&](Offset i, const auto& add) {
      if (open_stop(i).next >= 0) add(open_[i]);
    });
  }

  /// The end of the i-th path.
  SentEnd end(Offset i) const { return {stops_[i].rank, stops_[i].place}; }

 private:
  /// Follows paths in this rank's part, from start(i) for each i below `count`.
  template <class Start>
  void follow(Offset count, const Start& start, Stop* stops) const {
    if (count == 0) return;
    follow_each_path("GALE::follow_here", simplices_.successors(), count, start,
                     [&](Offset i, Id last, Id next) { stops[i] = stop_at(last, next); });
    std::vector<Id> left;
    std::vector<Stop*> at;
    for (Offset i = 0; i < count; ++i) {
      if (stops[i].next < 0) continue;
      left.push_back(std::exchange(stops[i].place, no_id));
      at.push_back(&stops[i]);
    }
    const std::vector<int> owners = simplices_.owners(left);
    for (std::size_t i = 0; i < at.size(); ++i) at[i]->rank = owners[i];
  }

  /// Says where a path ends. Where it leaves the part the place is that simplex, and the rank isn't known yet.
  Stop stop_at(Id last, Id next) const {
    if (next == no_id) {
      return {simplices_.mesh().exchange().ranks().rank(),
              simplices_.are_vertices() ? places_.of_vertex(last) : places_.of_cell(last), -1};
    }
    if (next == DiscreteGradient::elsewhere) return {SentEnd::outside, last, simplices_.global(last)};
    return {};
  }

  const PathSimplices& simplices_;
  const CriticalPlaces& places_;
  std::vector<Stop> stops_;
  std::vector<Id> open_;  ///< the paths that others have to follow
};

/// A simplex of one of the two kinds from which another rank is asked to follow a path; in 64 bits to be packed without
/// gaps.
struct AskedEnd {
  GlobalId simplex;
  std::int64_t kind;
};

/// Follows paths of both kinds, from rank to rank, to their ends: in as many rounds of messages as that one takes that
/// changes ranks most often. Collective.
void follow_to_ends(const Ranks& ranks, std::array<Followers, 2>& kinds) {
  const auto of_open = [&](Id i) -> std::pair<int, Offset> {
    return i < kinds[0].open() ? std::make_pair(0, Offset(i)) : std::make_pair(1, i - kinds[0].open());
  };
  const auto stop_of = [&](Id i) -> const Stop& {
    const auto [kind, place] = of_open(i);
    return kinds[kind].open_stop(place);
  };
  const auto answer_all = [&](const EntriesByRank<AskedEnd>& asked, const Array<Stop, HostMemory>& answers) {
    for (std::int64_t kind = 0; kind < 2; ++kind) {
      const std::vector<Id> places = collected<Id>("GALE::asked_ends", asked.count(), [&](Offset i, const auto& add) {
        if (asked.entries(i).kind == kind) add(static_cast<Id>(i));
      });
      const std::vector<Stop> found = kinds[kind].follow_others(
          static_cast<Offset>(places.size()), [&](Offset i) { return asked.entries(places[i]).simplex; });
      for (std::size_t i = 0; i < places.size(); ++i) answers(places[i]) = found[i];
    }
  };
  while (ranks.sum(kinds[0].open() + kinds[1].open()) != 0) {
    const auto answers = ask_for_all<Stop>(
        ranks, "GALE::ends_elsewhere", kinds[0].open() + kinds[1].open(), [&](Id i) { return stop_of(i).rank; },
        [&](Id i) {
          return AskedEnd{stop_of(i).next, of_open(i).first};
        },
        answer_all);
    together(ranks, [&] {
      const Offset before = kinds[0].open();
      kinds[0].take([&](Offset i) { return answers(i); });
      kinds[1].take([&](Offset i) { return answers(before + i); });
    });
  }
}

}  // namespace

EndsOfSaddles ends_on_ranks(const DiscreteGradient& gradient, const CriticalPlaces& places) {
  const CriticalSimplices& critical = gradient.critical();
  const Ranks& ranks = gradient.mesh().exchange().ranks();
  const auto vertices = PathSimplices::make(gradient, PathSimplices::Kind::falling_vertices);
  const auto cells = PathSimplices::make(gradient, PathSimplices::Kind::rising_cells);
  std::array<Followers, 2> kinds{Followers(*vertices, places), Followers(*cells, places)};
  together(ranks, [&] {
    std::vector<Id> corners;
    reserve(corners, 2 * critical.edges.size());
    for (const auto& [high, low] : critical.edges) corners.insert(corners.end(), {high, low});
    kinds[0].set_out(corners);
    kinds[1].set_out(critical.star);
  });
  follow_to_ends(ranks, kinds);
  EndsOfSaddles ends;
  together(ranks, [&] {
    ends.of_edges.resize(critical.edges.size());
    parallel_for("GALE::ends_of_edges", HostExecutionSpace(), ends.of_edges.size(), [&](Offset i) {
      ends.of_edges[i] = {kinds[0].end(2 * i), kinds[0].end(2 * i + 1)};
    });
    ends.of_facets.resize(critical.star_begin.size() - 1);
    parallel_for("GALE::ends_of_facets", HostExecutionSpace(), ends.of_facets.size(), [&](Offset i) {
      const Id first = critical.star_begin[i];
      for (Id k = first; k < critical.star_begin[i + 1]; ++k) ends.of_facets[i][k - first] = kinds[1].end(k);
    });
  });
  return ends;
}

}  // namespace gale::detail
