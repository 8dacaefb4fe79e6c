#include <algorithm>
#include <type_traits>
#include <utility>

#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/morse_smale/paths_on_ranks.hpp>
#include <gale/base/atomic.hpp>
#include <gale/base/error.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/sort.hpp>
#include <gale/mesh/exchange/messages.hpp>
#include <gale/mesh/exchange/places.hpp>

namespace gale::detail {

namespace {

/// What a rank finds of its paths by itself.
struct PathsHere {
  std::vector<Id> exits;         ///< ascending
  Mirrored<Id> ends;             ///< of each simplex: the critical one's place, or after all of these the exit's
  std::vector<char> is_reached;  ///< which exits paths from other simplices come to
};

/// Marks an exit that the path from another simplex comes to.
template <class Memory>
struct MarkReached {
  Array<const Id, Memory> ends, exits;
  Id criticals;
  Array<char, Memory> is_reached;

  KOKKOS_FUNCTION void operator()(Offset i) const {
    const Id at = place_of_end(ends(i)) - criticals;
    if (at >= 0 && exits(at) != i) atomic_write(&is_reached(at), char(1));
  }
};

/// Marks the exits that paths from other simplices come to; of many simplices at once none does, mostly.
template <class Space>
void mark_reached(const Space& space, const MarkReached<MemoryOf<Space>>& mark) {
  const Offset all = mark.ends.extent(0);
  fill("GALE::reached_exits", space, mark.is_reached, char(0));
  if constexpr (is_device<Space>) {
    parallel_for("GALE::reached_exits", space, all, mark);
    space.fence();
  } else {
    constexpr Offset block = 64;
    const Id* const ends = mark.ends.data();
    for_parts("GALE::reached_exits", all, threads_for(all), [&](int, Offset first, Offset last) {
      for (Offset begin = first; begin < last; begin += block) {
        const Offset end = std::min(begin + block, last);
        Id least = 0;
        for (Offset i = begin; i < end; ++i) least = std::min(least, ends[i]);
        if (least > end_at(mark.criticals)) continue;
        for (Offset i = begin; i < end; ++i) mark(i);
      }
    });
  }
}

template <class Space>
PathsHere follow_here(const Space& space, const PathSimplices& simplices) {
  using Memory = MemoryOf<Space>;
  const auto successors = simplices.successors().in<Memory>();
  const Interval inner = simplices.inner();
  const Array<Id, Memory> exits = selected(
      "GALE::find_exits", space, static_cast<Offset>(successors.extent(0)) - inner.size(),
      KOKKOS_LAMBDA(Offset i) { return successors(inner.outside(i)) == DiscreteGradient::elsewhere; });
  parallel_for(
      "GALE::name_exits", space, exits.extent(0), KOKKOS_LAMBDA(Offset i) { exits(i) = inner.outside(exits(i)); });
  space.fence();
  const auto exits_on_host = on_host(exits);
  PathsHere here{{exits_on_host.data(), exits_on_host.data() + exits_on_host.extent(0)}, {}, {}};
  std::vector<Id> ends = simplices.critical();
  ends.insert(ends.end(), here.exits.begin(), here.exits.end());
  const Array<Id, Memory> next = with_ends(space, simplices.successors(), ends);
  jump(space, next);
  const auto is_reached = allocate<Array<char, Memory>>("GALE::reached_exits", exits.extent(0));
  mark_reached(space, MarkReached<Memory>{next, exits, static_cast<Id>(simplices.critical().size()), is_reached});
  space.fence();
  here.ends = next;
  const auto reached_on_host = on_host(is_reached);
  here.is_reached.assign(reached_on_host.data(), reached_on_host.data() + reached_on_host.extent(0));
  return here;
}

}  // namespace

PathSimplices::PathSimplices(const DiscreteGradient& gradient, Kind kind)
    : mesh_(gradient.mesh()),
      are_vertices_(kind == Kind::falling_vertices),
      successors_(are_vertices_ ? gradient.store().vertex_successors() : gradient.store().cell_successors()),
      critical_(are_vertices_ ? gradient.critical().vertices : gradient.critical().cells),
      input_(are_vertices_ ? mesh().vertices_in_input() : mesh().cells_in_input()),
      vertex_input_(mesh().vertices_in_input()),
      keys_(are_vertices_ ? nullptr : gradient.order().keys()),
      corners_(mesh().cell_reader()) {
  if (are_vertices_ || mesh().grid() != nullptr) return;
  const Id cells = mesh().cells();
  const Interval owned = mesh().owned_vertices();
  for (Id t = 0; t < cells; ++t) {
    const Quad corners = corners_(t);
    if (!owned.has(corners.a) || !owned.has(corners.d))  // corners ascend
      shared_cells_.insert(static_cast<std::uint64_t>(input_[t])).first = t;
  }
}

PathSimplices::PathSimplices(const VertexOrder& order, const Mirrored<Id>& successors, const std::vector<Id>& ends)
    : mesh_(order.mesh()),
      are_vertices_(true),
      successors_(successors),
      critical_(ends),
      input_(mesh_.vertices_in_input()),
      vertex_input_(input_),
      keys_(nullptr),
      corners_(mesh_.cell_reader()) {}

std::unique_ptr<const PathSimplices> PathSimplices::make(const DiscreteGradient& gradient, Kind kind) {
  std::unique_ptr<const PathSimplices> made;
  together(gradient.mesh().exchange().ranks(), [&] { made = std::make_unique<const PathSimplices>(gradient, kind); });
  return made;
}

GlobalId PathSimplices::global(Id simplex) const {
  return are_vertices_ ? mesh().vertex_id(input_[simplex]) : mesh().cell_id(input_[simplex]);
}

Id PathSimplices::local(GlobalId id) const {
  if (are_vertices_) return mesh().vertices_of_input()[mesh().vertex_of(id)];
  const Id cell = mesh().exchange().cell_of(id);
  return mesh().grid() != nullptr ? cell : *shared_cells_.find(static_cast<std::uint64_t>(cell));
}

Interval PathSimplices::inner() const {
  const Interval owned = mesh().owned_vertices();
  if (are_vertices_) return owned;
  return mesh().grid() == nullptr ? Interval{0, 0} : mesh().grid()->cells_within(owned);
}

int PathSimplices::owner(Id simplex) const {
  Id highest = simplex;
  if (!are_vertices_) {
    const Quad corners = corners_(simplex);
    highest = corners.a;
    for (const Id vertex : {corners.b, corners.c, corners.d}) {
      if (keys_[vertex] > keys_[highest]) highest = vertex;
    }
  }
  return mesh().exchange().owner(vertex_input_[highest]);
}

PathsOnRanks::PathsOnRanks(const PathSimplices& simplices, const std::vector<Id>& others)
    : simplices_(simplices), criticals_(static_cast<Id>(simplices.critical().size())) {
  together(ranks(), [&] { find_exits(others); });
  while (jump()) {
  }
}

void PathsOnRanks::find_exits(const std::vector<Id>& others) {
  PathsHere here = in_worker_or_host_space(simplices_.successors().on_device(),
                                           [&](const auto& space) { return follow_here(space, simplices_); });
  exits_ = std::move(here.exits);
  ends_ = here.ends;
  std::vector<char> is_reached = std::move(here.is_reached);
  for (const Id other : others) is_reached[std::lower_bound(exits_.begin(), exits_.end(), other) - exits_.begin()] = 1;
  for (std::size_t i = 0; i < exits_.size(); ++i) {
    if (is_reached[i] != 0) open_.push_back(static_cast<Id>(i));
  }
  stops_.resize(exits_.size());
  parallel_for("GALE::first_stops", HostExecutionSpace(), open_.size(), [&](Offset i) {
    const Id exit = exits_[open_[i]];
    stops_[open_[i]] = {simplices_.owner(exit), simplices_.global(exit)};
  });
  parallel_sort("GALE::sort_exits", open_.begin(), open_.end(),
                [&](Id a, Id b) { return stops_[a].id < stops_[b].id; });
}

std::vector<Id> PathsOnRanks::ends_of(const std::vector<Id>& simplices) const {
  return in_worker_or_host_space(ends_.on_device(), [&](const auto& space) {
    return detail::ends_of(space, ends_.in<MemoryOf<std::decay_t<decltype(space)>>>(), simplices);
  });
}

std::vector<Id> PathsOnRanks::exits_from(const std::vector<Id>& simplices) const {
  std::vector<char> is_found(exits_.size(), 0);
  std::vector<Id> found;
  for (const Id at : ends_of(simplices)) {
    if (at >= criticals_ && std::exchange(is_found[at - criticals_], 1) == 0) found.push_back(exits_[at - criticals_]);
  }
  return found;
}

PathStop PathsOnRanks::final_stop(Id end) const {
  if (end == no_id) return {};
  if (end >= criticals_) return stops_[end - criticals_];
  return {PathStop::critical, simplices_.global(simplices_.critical()[end])};
}

Array<const Id, HostMemory> PathsOnRanks::places_of_ends() const {
  GlobalIndex different;  // critical simplices where paths end
  Array<SimplexKey, HostMemory> keys;
  const auto is_critical = [&](Id end) { return final_stop(end).rank == PathStop::critical; };
  together(ranks(), [&] {
    const auto all = collected<Id>("GALE::critical_ends", ends(), [&](Offset end, const auto& add) {
      if (is_critical(static_cast<Id>(end))) add(static_cast<Id>(end));
    });
    const auto ids = allocate<GlobalIds>("GALE::ids_of_ends", all.size());
    parallel_for("GALE::ids_of_ends", HostExecutionSpace(), ids.extent(0),
                 [&](Offset i) { ids(i) = final_stop(all[i]).id; });
    different = GlobalIndex(distinct_ids(ids).ids);
    keys = allocate<decltype(keys)>("GALE::end_keys", different.count());
    for (Offset i = 0; i < different.count(); ++i) keys(i) = {different[i], 0, 0};
  });
  const PlacesOfAll found = places_of_keys(ranks(), keys);
  Array<Id, HostMemory> places;
  together(ranks(), [&] {
    require_ids("minima or maxima of all ranks", found.count);
    places = allocate<Array<Id, HostMemory>>("GALE::places_of_ends", ends());
    parallel_for("GALE::places_of_ends", HostExecutionSpace(), ends(), [&](Offset i) {
      const Id end = static_cast<Id>(i);
      places(end) = is_critical(end) ? static_cast<Id>(found.places(different.find(final_stop(end).id))) : no_id;
    });
  });
  return places;
}

/// One round: each exit whose path goes on elsewhere learns from the rank where it is how it ends there. False, and
/// nothing done, if all have ended on all ranks.
bool PathsOnRanks::jump() {
  if (ranks().sum(static_cast<std::int64_t>(open_.size())) == 0) return false;
  const auto next = ask_for_all<PathStop>(
      ranks(), "GALE::next_stops", static_cast<Offset>(open_.size()), [&](Id i) { return stops_[open_[i]].rank; },
      [&](Id i) { return stops_[open_[i]].id; },
      [&](const auto& asked, const auto& answers) {
        std::vector<Id> starts(asked.count());
        parallel_for("GALE::asked_starts", HostExecutionSpace(), asked.count(),
                     [&](Offset i) { starts[i] = simplices_.local(asked.entries(i)); });
        const std::vector<Id> ends = ends_of(starts);
        parallel_for("GALE::answered_stops", HostExecutionSpace(), asked.count(),
                     [&](Offset i) { answers(i) = final_stop(ends[i]); });
      });
  std::vector<Id> still;
  for (std::size_t i = 0; i < open_.size(); ++i) {
    stops_[open_[i]] = next(i);
    if (!next(i).is_end()) still.push_back(open_[i]);
  }
  open_.swap(still);
  ++rounds_;
  return true;
}

}  // namespace gale::detail
