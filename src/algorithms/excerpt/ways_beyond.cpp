#include <algorithm>
#include <memory>
#include <utility>

#include <gale/algorithms/excerpt/edge_fall.hpp>
#include <gale/algorithms/excerpt/found_for_ranks.hpp>
#include <gale/algorithms/excerpt/gathering.hpp>
#include <gale/algorithms/excerpt/path_steps.hpp>
#include <gale/algorithms/excerpt/ways_beyond.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort.hpp>
#include <gale/base/stop.hpp>

namespace gale::detail {

namespace {

/// What goes on along a way.
enum class WayKind : std::int32_t { falling_vertices, rising_cells, falling_edges };

/// A way that a rank asks another to follow on, for one whose way it was at first.
struct SentWay {
  WayKind kind;
  std::int32_t asker;
  GlobalId simplex;  ///< where it goes on; of an edge the higher end
  GlobalId more;     ///< the lower end; of a path the exit of the rank that is asked which it comes to, no_id: none
};

/// The parts of paths of one kind that this rank follows for all that ask.
class PathsBeyond {
 public:
  PathsBeyond(const PathSimplices& simplices, const ExitLinks& links)
      : simplices_(simplices), links_(links), left_(ranks()), starts_(ranks()) {}

  /// Calls hand_on(owner, simplex, exit) for an exit of this rank's, unless the path of one who asks has come there
  /// before.
  template <class HandOn>
  void leave(int asker, Id exit, const HandOn& hand_on) {
    if (!left_[asker].insert(static_cast<std::uint64_t>(exit)).second) return;
    const ExitLink& link = links_.links(exit);
    hand_on(link.owner, simplices_.global(links_.exits(exit)), link.exit);
  }

  void begin_at(int asker, GlobalId simplex) { starts_[asker].push_back(simplices_.local(simplex)); }

  /// The steps of one rank's paths here, each a simplex and its successor, by GALE's ids: ascending, once each.
  std::vector<std::array<Id, 2>> steps(int asker) {
    std::vector<Id>& starts = starts_[asker];
    if (starts.empty()) return {};
    sort_distinct("GALE::sort_starts", starts);
    const Mirrored<Id>& successors = simplices_.successors();
    auto steps = in_worker_or_host_space(successors.on_device(), [&](const auto& space) {
      using Space = std::decay_t<decltype(space)>;
      if constexpr (is_device<Space>) {
        const SteppedPaths paths = step_along_paths(space, successors.in<MemoryOf<Space>>(), starts);
        return concatenated(of_parts("GALE::steps_beyond", paths.simplices.extent(0), [&](Offset begin, Offset end) {
          std::vector<std::array<Id, 2>> steps;
          for_range(begin, end, [&](Offset i) {
            if (paths.next(i) != DiscreteGradient::elsewhere) steps.push_back({paths.simplices(i), paths.next(i)});
          });
          std::sort(steps.begin(), steps.end());
          steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
          return steps;
        }));
      } else {
        std::vector<std::array<Id, 2>> steps;
        HashTable<IsSeen> passed;
        const Id* const next = successors.in<HostMemory>().data();
        for (Id at : starts) {
          stop_if_asked();
          for (; at >= 0 && next[at] != DiscreteGradient::elsewhere; at = next[at]) {
            if (!passed.insert(static_cast<std::uint64_t>(at)).second) break;
            steps.push_back({at, next[at]});
          }
        }
        return steps;
      }
    });
    sort_distinct("GALE::steps_beyond", steps);
    return steps;
  }

 private:
  std::size_t ranks() const { return simplices_.mesh().exchange().ranks().size(); }

  const PathSimplices& simplices_;
  const ExitLinks& links_;
  std::vector<HashTable<IsSeen>> left_;  ///< by asker
  std::vector<std::vector<Id>> starts_;  ///< by asker
};

/// All ways that this rank follows.
class WaysBeyond {
 public:
  WaysBeyond(const DiscreteGradient& gradient, const PathSimplices& cells, const WayExits& exits)
      : gradient_(gradient),
        mesh_(gradient.mesh()),
        ranks_(mesh_.exchange().ranks()),
        input_(mesh_.vertices_in_input()),
        internal_(mesh_.vertices_of_input()),
        cell_simplices_(cells),
        vertex_simplices_(gradient, PathSimplices::Kind::falling_vertices),
        vertices_(vertex_simplices_, exits.vertices),
        cells_(cells, exits.cells),
        falling_(ranks_.size()),
        falls_(ranks_.size()),
        found_(gradient.order()) {
    for (const Id exit : exits.vertices.wanted) leave(WayKind::falling_vertices, ranks_.rank(), exit);
    for (const Id exit : exits.cells.wanted) leave(WayKind::rising_cells, ranks_.rank(), exit);
    falling_[ranks_.rank()] = exits.edges;
  }

  /// Takes ways that come here, lets their edges fall with all that these come to, and returns what others have to
  /// follow.
  EntriesByRank<SentWay> follow(const EntriesByRank<SentWay>& received) {
    for (Offset i = 0; i < received.count(); ++i) take(received.entries(i));
    fall();
    return entries_by_rank(ranks_.size(), "GALE::ways", std::exchange(elsewhere_, {}));
  }

  /// What was found for the others, when nobody has anything left.
  FoundForRanks& found() {
    falls_[ranks_.rank()].reset();
    for (int asker = 0; asker < ranks_.size(); ++asker) {
      if (falls_[asker]) found_[asker].edges = falls_[asker]->passed();
      falls_[asker].reset();
    }
    const CellReader corners = mesh_.cell_reader();
    for (int asker = 0; asker < ranks_.size(); ++asker) {
      found_[asker].vertex_steps = vertices_.steps(asker);
      found_[asker].set_cell_steps(cells_.steps(asker), corners, cell_simplices_);
    }
    found_.number_vertices();
    return found_;
  }

 private:
  PathsBeyond& paths(WayKind kind) { return kind == WayKind::falling_vertices ? vertices_ : cells_; }

  void fall() {
    for (int asker = 0; asker < ranks_.size(); ++asker) {
      if (falling_[asker].empty()) continue;
      if (!falls_[asker]) falls_[asker] = std::make_unique<EdgeFall>(gradient_, asker == ranks_.rank());
      const auto left = falls_[asker]->fall(std::exchange(falling_[asker], {}));
      const std::size_t before = elsewhere_.size();
      elsewhere_.resize(before + left.size());
      parallel_for("GALE::left_edges", HostExecutionSpace(), left.size(), [&](Offset i) {
        const auto [high, low] = left[i];
        elsewhere_[before + i] = {mesh_.exchange().owner(input_[high]),
                                  {WayKind::falling_edges, asker, global(high), global(low)}};
      });
    }
  }

  GlobalId global(Id vertex) const { return mesh_.vertex_id(input_[vertex]); }
  Id local(GlobalId vertex) const { return internal_[mesh_.vertex_of(vertex)]; }

  void hand_on(int rank, const SentWay& way) { elsewhere_.push_back({rank, way}); }

  void leave(WayKind kind, int asker, Id exit) {
    paths(kind).leave(asker, exit, [&](int owner, GlobalId simplex, Id next) {
      hand_on(owner, {kind, asker, simplex, next});
    });
  }

  void take(const SentWay& way) {
    if (way.kind == WayKind::falling_edges) {
      falling_[way.asker].push_back({local(way.simplex), local(way.more)});
      return;
    }
    if (way.asker != ranks_.rank()) paths(way.kind).begin_at(way.asker, way.simplex);
    if (way.more != no_id) leave(way.kind, way.asker, static_cast<Id>(way.more));
  }

  const DiscreteGradient& gradient_;
  const Mesh mesh_;
  const Ranks& ranks_;
  const OtherIds input_, internal_;
  const PathSimplices& cell_simplices_;
  const PathSimplices vertex_simplices_;
  PathsBeyond vertices_, cells_;
  std::vector<std::vector<std::array<Id, 2>>> falling_;  ///< edges that have come here, by asker
  std::vector<std::unique_ptr<EdgeFall>> falls_;         ///< by asker
  FoundForRanks found_;
  std::vector<std::pair<int, SentWay>> elsewhere_;
};

}  // namespace

Reached reach_beyond(const DiscreteGradient& gradient, const PathSimplices& cells, const WayExits& exits) {
  const Ranks& ranks = gradient.mesh().exchange().ranks();
  std::unique_ptr<WaysBeyond> ways;
  together(ranks, [&] { ways = std::make_unique<WaysBeyond>(gradient, cells, exits); });
  in_rounds<SentWay>(ranks, "GALE::ways", [&](const auto& received) { return ways->follow(received); });
  FoundForRanks* found = nullptr;
  together(ranks, [&] { found = &ways->found(); });
  require_room(ranks, "what critical simplices reach", found->bytes(), 0);
  return found->send();
}

}  // namespace gale::detail
