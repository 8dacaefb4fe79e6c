#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include <gale/algorithms/excerpt/found_for_ranks.hpp>
#include <gale/algorithms/excerpt/gathering.hpp>
#include <gale/algorithms/excerpt/path_steps.hpp>
#include <gale/algorithms/excerpt/reached.hpp>
#include <gale/algorithms/gradient/edges_on_host.hpp>
#include <gale/algorithms/morse_smale/edge_star.hpp>
#include <gale/algorithms/morse_smale/paths_on_ranks.hpp>
#include <gale/base/error.hpp>

namespace gale::detail {

namespace {

enum class StepKind : std::int32_t { falling_vertex, falling_edge, rising_cell, rising_edge, rising_triangle };

/// A simplex (GALE's ids) from which a way goes on that a rank has asked for.
struct LocalStep {
  StepKind kind;
  int asker;
  std::array<Id, 3> simplex;
};

/// One that another rank follows, by global ids.
struct SentStep {
  StepKind kind;
  int asker;
  std::array<GlobalId, 3> simplex;
};

/// Where ways have been for one that asks.
struct Been {
  HashTable<IsSeen> fallen_vertices, fallen_edges, told_edges, risen_cells, risen_edges;
};

class Reacher {
 public:
  Reacher(const DiscreteGradient& gradient, const WantedWays& ways, Structure* rows)
      : gradient_(gradient),
        ways_(ways),
        mesh_(gradient.mesh()),
        owned_(mesh_.owned_vertices()),
        ranks_(mesh_.exchange().ranks()),
        cells_(gradient, PathSimplices::Kind::rising_cells),
        corners_(mesh_.cell_reader()),
        input_(mesh_.vertices_in_input()),
        internal_(mesh_.vertices_of_input()),
        cell_successors_(gradient.store().cell_successors(), gradient.store().further_successors.empty()),
        further_(gradient.store().further_successors),
        edges_(gradient),
        found_(gradient.order()),
        been_(ranks_.size()) {
    if (!ways.rising_walls) return;
    consumer_ = rows->consumer();
    star_.emplace(mesh_);
  }

  /// From this rank's critical simplices.
  void begin() {
    const int asker = ways_.all_for_first ? 0 : ranks_.rank();
    FoundFor& found = found_of(asker);
    const CriticalSimplices& critical = gradient_.critical();
    for (const Id vertex : critical.vertices) go({StepKind::falling_vertex, asker, {vertex}});
    for (const Id cell : critical.cells) go({StepKind::rising_cell, asker, {cell}});
    for (const auto& [high, low] : critical.edges) {
      tell_edge(asker, high, low);
      if (ways_.falling_paths) {
        for (const Id vertex : {high, low}) go({StepKind::falling_vertex, asker, {vertex}});
      }
      if (ways_.rising_walls) go({StepKind::rising_edge, asker, {high, low}});
    }
    for (const auto& triangle : critical.triangles) {
      found.critical_triangles.push_back(triangle);
      if (!ways_.falling_walls) continue;
      for (int i = 0; i < 3; ++i) fall_to(asker, triangle[i], triangle[(i + 1) % 3]);
    }
    begin_stars(asker, found);
    if (ways_.all_for_first && owned_.size() > 0)  // the highest one of all is where classes end that never do
      found.more_vertices.push_back(gradient_.order().highest(owned_));
  }

  /// Takes all steps that this rank can.
  void follow() {
    std::vector<Id> rising;
    for (const LocalStep& step : here_) {
      if (step.kind == StepKind::rising_cell) rising.push_back(step.simplex[0]);
    }
    cell_successors_.follow(std::move(rising));
    for (std::int64_t i = 0; !here_.empty(); ++i) {
      stop_if_asked_at(i);
      const LocalStep step = here_.back();
      here_.pop_back();
      take(step);
    }
    leave_cells();
  }

  /// Takes steps of ways that come here, follows them, and returns what others have to follow.
  EntriesByRank<SentStep> follow(const EntriesByRank<SentStep>& received) {
    for (Offset i = 0; i < received.count(); ++i) go(here(received.entries(i)));
    follow();
    return entries_by_rank(ranks_.size(), "GALE::steps", std::exchange(elsewhere_, {}));
  }

  /// What was found for all ranks, when nobody has anything left.
  FoundForRanks& found() { return found_; }

 private:
  FoundFor& found_of(int asker) { return found_[asker]; }

  bool is_owned(Id vertex) const { return owned_.has(vertex); }
  Id higher(Id a, Id b) const { return edges_.is_higher(a, b) ? a : b; }

  void begin_stars(int asker, FoundFor& found) {
    const CriticalSimplices& critical = gradient_.critical();
    for (std::size_t i = 0; i + 1 < critical.star_begin.size(); ++i) {
      std::array<Id, 4> in_star{0, 0, no_id, 0};
      const auto set_facet = [&](const auto& facet) { std::copy(facet.begin(), facet.end(), in_star.begin()); };
      critical.dimension == 3 ? set_facet(critical.triangles[i]) : set_facet(critical.edges[i]);
      for (Id k = critical.star_begin[i]; k < critical.star_begin[i + 1]; ++k) {
        in_star[3] = cell_place(found, critical.star[k]);
        found.critical_stars.push_back(in_star);
        if (ways_.rising_paths) go({StepKind::rising_cell, asker, {critical.star[k]}});
      }
    }
  }

  /// Goes on from a simplex, unless that was done: here, or where the rank is that knows how. Cells are known to be
  /// another rank's when they are taken.
  void go(const LocalStep& step) {
    Been& been = been_[step.asker];
    const auto [a, b, c] = step.simplex;
    Id highest = a;
    switch (step.kind) {
      case StepKind::falling_vertex:
        if (!been.fallen_vertices.insert(static_cast<std::uint64_t>(a)).second) return;
        break;
      case StepKind::falling_edge:
        if (!been.fallen_edges.insert(pair_key(a, b)).second) return;
        break;
      case StepKind::rising_cell:
        if (been.risen_cells.insert(static_cast<std::uint64_t>(a)).second) here_.push_back(step);
        return;
      case StepKind::rising_edge:
        if (!been.risen_edges.insert(pair_key(a, b)).second) return;
        break;
      case StepKind::rising_triangle:
        highest = higher(a, higher(b, c));
        break;
    }
    if (is_owned(highest)) {
      here_.push_back(step);
    } else {
      elsewhere_.push_back({mesh_.exchange().owner(input_[highest]), global(step)});
    }
  }

  static int vertices_of(StepKind kind) {
    return kind == StepKind::falling_vertex    ? 1
           : kind == StepKind::rising_cell     ? 0
           : kind == StepKind::rising_triangle ? 3
                                               : 2;
  }

  SentStep global(const LocalStep& step) const {
    SentStep sent{step.kind, step.asker, {}};
    for (int i = 0; i < vertices_of(step.kind); ++i) sent.simplex[i] = mesh_.vertex_id(input_[step.simplex[i]]);
    if (step.kind == StepKind::rising_cell) sent.simplex[0] = cells_.global(step.simplex[0]);
    return sent;
  }

  LocalStep here(const SentStep& sent) const {
    LocalStep step{sent.kind, sent.asker, {}};
    for (int i = 0; i < vertices_of(sent.kind); ++i) step.simplex[i] = internal_[mesh_.vertex_of(sent.simplex[i])];
    if (sent.kind == StepKind::rising_cell) step.simplex[0] = cells_.local(sent.simplex[0]);
    return step;
  }

  void take(const LocalStep& step) {
    FoundFor& found = found_of(step.asker);
    const auto [a, b, c] = step.simplex;
    switch (step.kind) {
      case StepKind::falling_vertex:
        return take_vertex(step.asker, found, a);
      case StepKind::falling_edge: {
        const Id third = tell_edge(step.asker, a, b);
        if (third < 0) return;
        fall_to(step.asker, a, third);
        return fall_to(step.asker, b, third);
      }
      case StepKind::rising_cell:
        return take_cell(step.asker, found, a);
      case StepKind::rising_edge:
        star_->find(a, b, consumer_->row(Relation::VT, a));
        for (const Id cell : star_->around()) cell_place(found, cell);
        for (const Id third : star_->thirds()) go({StepKind::rising_triangle, step.asker, {a, b, third}});
        return;
      case StepKind::rising_triangle:
        return cross(step.asker, step.simplex);
    }
  }

  void fall_to(int asker, Id a, Id b) {
    const auto [high, low] = edges_.ordered(a, b);
    go({StepKind::falling_edge, asker, {high, low}});
  }

  /// Has others go on from the cells at which ways leave the part: all at once, as it takes keys to know whose these
  /// are.
  void leave_cells() {
    std::vector<Id> cells;
    for (const LocalStep& step : left_cells_) cells.push_back(step.simplex[0]);
    const std::vector<int> owners = cells_.owners(cells);
    for (std::size_t i = 0; i < cells.size(); ++i) elsewhere_.push_back({owners[i], global(left_cells_[i])});
    left_cells_.clear();
  }

  void take_vertex(int asker, FoundFor& found, Id vertex) {
    const Id next = edges_.vertex_successor(vertex);
    found.vertex_steps.push_back({vertex, next});
    if (next != no_id) go({StepKind::falling_vertex, asker, {next}});
  }

  void take_cell(int asker, FoundFor& found, Id cell) {
    const Id next = cell_successors_[cell];
    if (next == DiscreteGradient::elsewhere) {
      left_cells_.push_back({StepKind::rising_cell, asker, {cell}});
      return;
    }
    const Id place = found.add_step(cell, next, corners_, cells_);
    if (next >= 0) go({StepKind::rising_cell, asker, {next}});
    auto at = std::lower_bound(further_.begin(), further_.end(), std::make_pair(cell, Id(0)));
    for (; at != further_.end() && at->first == cell; ++at) {
      found.cell_forks.push_back({place, cell_place(found, at->second)});
      go({StepKind::rising_cell, asker, {at->second}});
    }
  }

  /// From a triangle to the edge that it is paired with, if there is one.
  void cross(int asker, std::array<Id, 3> triangle) {
    std::sort(triangle.begin(), triangle.end(), [this](Id a, Id b) { return edges_.is_higher(a, b); });
    for (int i = 1; i < 3; ++i) {
      if (tell_edge(asker, triangle[0], triangle[i]) == triangle[3 - i])
        go({StepKind::rising_edge, asker, {triangle[0], triangle[i]}});
    }
  }

  /// Notes what an edge is paired with for the rank that asks, once; returns it as EdgesOnHost does.
  Id tell_edge(int asker, Id high, Id low) {
    const Id third = edges_.third(high, low);
    if (been_[asker].told_edges.insert(pair_key(high, low)).second) found_of(asker).edges.push_back({high, low, third});
    return third;
  }

  Id cell_place(FoundFor& found, Id cell) const { return found.place_of(cell, corners_, cells_); }

  const DiscreteGradient& gradient_;
  const WantedWays ways_;
  const Mesh mesh_;
  const Interval owned_;
  const Ranks& ranks_;
  const PathSimplices cells_;
  const CellReader corners_;
  const OtherIds input_, internal_;
  PathSteps cell_successors_;
  const std::vector<std::pair<Id, Id>>& further_;
  const EdgesOnHost edges_;
  std::unique_ptr<Consumer> consumer_;  // of rising walls
  std::optional<EdgeStar> star_;
  FoundForRanks found_;
  std::vector<Been> been_;  ///< by asker
  std::vector<LocalStep> here_, left_cells_;
  std::vector<std::pair<int, SentStep>> elsewhere_;
};

}  // namespace

Reached reach(const DiscreteGradient& gradient, const WantedWays& ways, Structure* rows, std::size_t most_bytes) {
  const Ranks& ranks = gradient.mesh().exchange().ranks();
  std::unique_ptr<Reacher> reacher;
  together(ranks, [&] {
    reacher = std::make_unique<Reacher>(gradient, ways, rows);
    reacher->begin();
  });
  in_rounds<SentStep>(ranks, "GALE::steps", [&](const auto& received) { return reacher->follow(received); });
  FoundForRanks& found = reacher->found();
  together(ranks, [&] { found.number_vertices(); });
  require_room(ranks, "what critical simplices reach", found.bytes(), most_bytes);
  return found.send();
}

}  // namespace gale::detail
