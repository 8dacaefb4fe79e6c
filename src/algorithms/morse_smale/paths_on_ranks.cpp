#include <algorithm>
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

/// The ends of paths inside one rank: see jump().
Array<const Id, HostMemory> ends_here(const Mirrored<Id>& successors, const std::vector<Id>& ends) {
  return in_worker_or_host_space(successors.on_device(), [&](const auto& space) -> Array<const Id, HostMemory> {
    const auto next = with_ends(space, successors, ends);
    jump(space, next);
    space.fence();
    return on_host(next);
  });
}

}  // namespace

PathSimplices::PathSimplices(const DiscreteGradient& gradient, Kind kind)
    : mesh_(gradient.mesh()),
      are_vertices_(kind == Kind::falling_vertices),
      successors_(are_vertices_ ? gradient.store().vertex_successors() : gradient.store().cell_successors()),
      critical_(are_vertices_ ? gradient.critical().vertices : gradient.critical().cells),
      input_(are_vertices_ ? mesh().vertices_in_input() : mesh().cells_in_input()),
      vertex_input_(mesh().vertices_in_input()),
      keys_(gradient.order().keys()),
      corners_(mesh().cell_reader()) {
  if (are_vertices_ || mesh().grid() != nullptr) return;
  const Id cells = mesh().cells();
  const Interval owned = mesh().owned_vertices();
  for (Id t = 0; t < cells; ++t) {
    const Quad corners = corners_(t);
    if (!owned.has(corners.a) || !owned.has(corners.d))  // they ascend
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
      keys_(order.keys()),
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
  const auto& successors = simplices_.successors().in<HostMemory>();
  const Interval inner = simplices_.inner();
  const Offset all = successors.extent(0);
  exits_ = collected<Id>("GALE::find_exits", all - inner.size(), [&](Offset i, const auto& add) {
    const Offset simplex = i < inner.first ? i : i + inner.size();
    if (successors(simplex) == DiscreteGradient::elsewhere) add(static_cast<Id>(simplex));
  });
  std::vector<Id> ends = simplices_.critical();
  ends.insert(ends.end(), exits_.begin(), exits_.end());
  ends_ = ends_here(simplices_.successors(), ends);
  std::vector<char> is_reached = reached_exits();
  for (const Id other : others) {
    const Id at = end(other) - criticals_;
    if (at >= 0) is_reached[at] = 1;
  }
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

/// Marks the exits that paths from other simplices come to; of many simplices at once none does, mostly.
std::vector<char> PathsOnRanks::reached_exits() const {
  constexpr Offset block = 64;
  std::vector<char> is_reached(exits_.size(), 0);
  const Id* const ends = ends_.data();
  const Offset all = ends_.extent(0);
  for_parts("GALE::reached_exits", all, threads_for(all), [&](int, Offset first, Offset last) {
    for (Offset begin = first; begin < last; begin += block) {
      const Offset end = std::min(begin + block, last);
      Id least = 0;
      for (Offset i = begin; i < end; ++i) least = std::min(least, ends[i]);
      if (least > end_at(criticals_)) continue;
      for (Offset i = begin; i < end; ++i) {
        const Id at = place_of_end(ends[i]) - criticals_;
        if (at >= 0 && exits_[at] != i) atomic_write(&is_reached[at], char(1));
      }
    }
  });
  return is_reached;
}

std::vector<Id> PathsOnRanks::exits_from(const std::vector<Id>& simplices) const {
  std::vector<char> is_found(exits_.size(), 0);
  std::vector<Id> found;
  for (const Id simplex : simplices) {
    const Id at = end(simplex);
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
  const KeyPlaces found = places_of_keys(ranks(), keys);
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
  const auto next = ask<PathStop>(
      ranks(), "GALE::next_stops", static_cast<Offset>(open_.size()), [&](Id i) { return stops_[open_[i]].rank; },
      [&](Id i) { return stops_[open_[i]].id; }, [&](GlobalId id) { return final_stop(end(simplices_.local(id))); });
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
