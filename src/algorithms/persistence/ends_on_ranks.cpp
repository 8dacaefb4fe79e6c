#include <utility>

#include <gale/algorithms/excerpt/gathering.hpp>
#include <gale/algorithms/gradient/follow_each_path.hpp>
#include <gale/algorithms/morse_smale/paths_on_ranks.hpp>
#include <gale/algorithms/persistence/ends_on_ranks.hpp>
#include <gale/mesh/exchange/messages.hpp>

namespace gale::detail {

namespace {

/// Follows the paths from some simplices (GALE's ids) to their ends, each rank in its part.
class Followers {
 public:
  /// Collective. `places` has those of this rank's critical simplices.
  Followers(const PathSimplices& simplices, const CriticalPlaces& places)
      : simplices_(simplices), places_(places), ranks_(simplices.mesh().exchange().ranks()) {}

  std::vector<SentEnd> operator()(const std::vector<Id>& starts) {
    std::vector<Stop> stops;
    std::vector<Id> open;
    together(ranks_, [&] {
      stops.resize(starts.size());
      follow(
          static_cast<Offset>(starts.size()), [&](Offset i) { return starts[i]; }, stops.data());
      open = collected<Id>("GALE::open_paths", stops.size(), [&](Offset i, const auto& add) {
        if (stops[i].next >= 0) add(static_cast<Id>(i));
      });
    });
    while (ranks_.sum(static_cast<std::int64_t>(open.size())) != 0) {
      const auto answers = ask_for_all<Stop>(
          ranks_, "GALE::ends_elsewhere", static_cast<Offset>(open.size()), [&](Id i) { return stops[open[i]].rank; },
          [&](Id i) { return stops[open[i]].next; },
          [&](const auto& from, const auto& found) {
            follow(
                from.count(), [&](Offset i) { return simplices_.local(from.entries(i)); }, found.data());
          });
      together(ranks_, [&] {
        const Offset count = static_cast<Offset>(open.size());
        parallel_for("GALE::found_ends", HostExecutionSpace(), count, [&](Offset i) { stops[open[i]] = answers(i); });
        open = collected<Id>("GALE::open_paths", count, [&](Offset i, const auto& add) {
          if (answers(i).next >= 0) add(open[i]);
        });
      });
    }
    std::vector<SentEnd> ends;
    together(ranks_, [&] {
      ends.resize(stops.size());
      parallel_for("GALE::sent_ends", HostExecutionSpace(), ends.size(), [&](Offset i) {
        ends[i] = {stops[i].rank, stops[i].place};
      });
    });
    return ends;
  }

 private:
  /// Where a path ends, or which rank follows it on from where.
  struct Stop {
    int rank = SentEnd::outside;
    Id place = no_id;
    GlobalId next = -1;
  };

  /// Follows paths in this rank's part, from start(i) for each i below `count`.
  template <class Start>
  void follow(Offset count, const Start& start, Stop* stops) const {
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
    if (next == no_id)
      return {ranks_.rank(), simplices_.are_vertices() ? places_.of_vertex(last) : places_.of_cell(last), -1};
    if (next == DiscreteGradient::elsewhere) return {SentEnd::outside, last, simplices_.global(last)};
    return {};
  }

  const PathSimplices& simplices_;
  const CriticalPlaces& places_;
  const Ranks& ranks_;
};

}  // namespace

std::vector<SentEnds> ends_of_edges_on_ranks(const DiscreteGradient& gradient, const CriticalPlaces& places) {
  const auto& edges = gradient.critical().edges;
  const Ranks& ranks = gradient.mesh().exchange().ranks();
  std::vector<Id> starts;
  together(ranks, [&] {
    reserve(starts, 2 * edges.size());
    for (const auto& [high, low] : edges) starts.insert(starts.end(), {high, low});
  });
  const auto simplices = PathSimplices::make(gradient, PathSimplices::Kind::falling_vertices);
  const auto ends = Followers(*simplices, places)(starts);
  std::vector<SentEnds> by_edge;
  together(ranks, [&] {
    reserve(by_edge, edges.size());
    for (std::size_t i = 0; i < ends.size(); i += 2) by_edge.push_back({ends[i], ends[i + 1]});
  });
  return by_edge;
}

std::vector<SentEnds> ends_of_facets_on_ranks(const DiscreteGradient& gradient, const CriticalPlaces& places) {
  const CriticalSimplices& critical = gradient.critical();
  const auto simplices = PathSimplices::make(gradient, PathSimplices::Kind::rising_cells);
  const auto ends = Followers(*simplices, places)(critical.star);
  std::vector<SentEnds> by_facet;
  together(gradient.mesh().exchange().ranks(), [&] {
    reserve(by_facet, critical.star_begin.size());
    for (std::size_t i = 0; i + 1 < critical.star_begin.size(); ++i) {
      const Id first = critical.star_begin[i], count = critical.star_begin[i + 1] - first;
      by_facet.push_back({});
      for (Id k = 0; k < count; ++k) by_facet.back()[k] = ends[first + k];
    }
  });
  return by_facet;
}

}  // namespace gale::detail
