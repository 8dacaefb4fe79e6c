#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <gale/algorithms/excerpt/gathering.hpp>
#include <gale/algorithms/gradient/follow_each_path.hpp>
#include <gale/algorithms/morse_smale/paths_on_ranks.hpp>
#include <gale/algorithms/persistence/ends_on_ranks.hpp>
#include <gale/mesh/exchange/messages.hpp>

namespace gale::detail {

namespace {

/// A path on its way to the rank that follows it on, or, when it has ended, back to the one where it begins. Without
/// gaps, to be packed.
struct SentPath {
  std::int64_t kind;  ///< which of both
  GlobalId next;      ///< the simplex from which it goes on; below 0 where it has ended
  int origin;         ///< the rank where it begins
  Id path;            ///< its number there
  SentEnd end;        ///< where it has ended
};

/// Paths of one kind, followed in this rank's part.
class Followers {
 public:
  /// `places` has those of this rank's critical simplices. Refers to both.
  Followers(const PathSimplices& simplices, const CriticalPlaces& places) : simplices_(simplices), places_(places) {}

  /// Follows paths, the i-th from start(i) (GALE's id), as far as this rank knows them. Sets the end and `next` of
  /// each, and returns the ranks that follow on those that haven't ended.
  template <class Start>
  std::vector<int> follow(std::vector<SentPath>& paths, const Start& start) const {
    const Offset count = static_cast<Offset>(paths.size());
    std::vector<int> owners(count, SentEnd::outside);
    if (count == 0) return owners;
    std::vector<Id> last_of(count);
    follow_each_path("GALE::follow_here", simplices_.successors(), count, start, [&](Offset i, Id last, Id next) {
      SentPath& path = paths[i];
      const bool goes_on = next == DiscreteGradient::elsewhere;
      path.end = next == no_id ? end_at(last) : SentEnd{};
      path.next = goes_on ? simplices_.global(last) : -1;
      last_of[i] = last;
    });
    std::vector<Id> open, open_last;
    for (Offset i = 0; i < count; ++i) {
      if (paths[i].next < 0) continue;
      open.push_back(static_cast<Id>(i));
      open_last.push_back(last_of[i]);
    }
    const std::vector<int> of_open = simplices_.owners(open_last);
    for (std::size_t i = 0; i < open.size(); ++i) owners[open[i]] = of_open[i];
    return owners;
  }

  Id local(GlobalId simplex) const { return simplices_.local(simplex); }

 private:
  SentEnd end_at(Id critical) const {
    return {simplices_.mesh().exchange().ranks().rank(),
            simplices_.are_vertices() ? places_.of_vertex(critical) : places_.of_cell(critical)};
  }

  const PathSimplices& simplices_;
  const CriticalPlaces& places_;
};

/// Follows paths of both kinds from rank to rank to their ends, each of which it sends back to where the path begins:
/// a round of messages for each time that the path changes ranks which does so most often, and one more.
class PathsToEnds {
 public:
  /// Paths from these simplices (GALE's ids), by kind.
  PathsToEnds(const Ranks& ranks, const std::array<Followers, 2>& kinds, std::array<std::vector<Id>, 2> starts)
      : ranks_(ranks), kinds_(kinds), starts_(std::move(starts)) {
    for (int kind = 0; kind < 2; ++kind) ends[kind].resize(starts_[kind].size());
  }

  /// Follows what has come here, its own paths in the first round, and returns what others are to know.
  EntriesByRank<SentPath> round(const EntriesByRank<SentPath>& received) {
    std::array<std::vector<SentPath>, 2> paths;
    for (Offset i = 0; i < received.count(); ++i) {
      const SentPath& path = received.entries(i);
      if (path.next < 0) {
        ends[path.kind][path.path] = path.end;
      } else {
        paths[path.kind].push_back(path);
      }
    }
    std::vector<std::pair<int, SentPath>> sent;
    for (std::int64_t kind = 0; kind < 2; ++kind) {
      const std::vector<Id> begun = std::exchange(starts_[kind], {});
      const Offset others = static_cast<Offset>(paths[kind].size());
      for (std::size_t i = 0; i < begun.size(); ++i)
        paths[kind].push_back({kind, -1, ranks_.rank(), static_cast<Id>(i), {}});
      std::vector<GlobalId> from;
      for (Offset i = 0; i < others; ++i) from.push_back(paths[kind][i].next);
      const std::vector<int> owners = kinds_[kind].follow(
          paths[kind], [&](Offset i) { return i < others ? kinds_[kind].local(from[i]) : begun[i - others]; });
      for (std::size_t i = 0; i < owners.size(); ++i) {
        const SentPath& path = paths[kind][i];
        if (path.next >= 0) {
          sent.emplace_back(owners[i], path);
        } else if (path.origin == ranks_.rank()) {
          ends[kind][path.path] = path.end;
        } else {
          sent.emplace_back(path.origin, path);
        }
      }
    }
    return entries_by_rank(ranks_.size(), "GALE::sent_paths", sent);
  }

  std::array<std::vector<SentEnd>, 2> ends;  ///< of the paths that begin here

 private:
  const Ranks& ranks_;
  const std::array<Followers, 2>& kinds_;
  std::array<std::vector<Id>, 2> starts_;
};

}  // namespace

EndsOfSaddles ends_on_ranks(const DiscreteGradient& gradient, const CriticalPlaces& places) {
  const CriticalSimplices& critical = gradient.critical();
  const Ranks& ranks = gradient.mesh().exchange().ranks();
  const auto vertices = PathSimplices::make(gradient, PathSimplices::Kind::falling_vertices);
  const auto cells = PathSimplices::make(gradient, PathSimplices::Kind::rising_cells);
  const std::array<Followers, 2> kinds{Followers(*vertices, places), Followers(*cells, places)};
  std::optional<PathsToEnds> paths;
  together(ranks, [&] {
    std::vector<Id> corners;
    reserve(corners, 2 * critical.edges.size());
    for (const auto& [high, low] : critical.edges) corners.insert(corners.end(), {high, low});
    paths.emplace(ranks, kinds, std::array<std::vector<Id>, 2>{std::move(corners), critical.star});
  });
  in_rounds<SentPath>(ranks, "GALE::paths_elsewhere", [&](const auto& received) { return paths->round(received); });
  EndsOfSaddles ends;
  together(ranks, [&] {
    ends.of_edges.resize(critical.edges.size());
    parallel_for("GALE::ends_of_edges", HostExecutionSpace(), ends.of_edges.size(), [&](Offset i) {
      ends.of_edges[i] = {paths->ends[0][2 * i], paths->ends[0][2 * i + 1]};
    });
    ends.of_facets.resize(critical.star_begin.size() - 1);
    parallel_for("GALE::ends_of_facets", HostExecutionSpace(), ends.of_facets.size(), [&](Offset i) {
      const Id first = critical.star_begin[i];
      for (Id k = first; k < critical.star_begin[i + 1]; ++k) ends.of_facets[i][k - first] = paths->ends[1][k];
    });
  });
  return ends;
}

}  // namespace gale::detail
