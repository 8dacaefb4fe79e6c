#include <algorithm>

#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/morse_smale/jump.hpp>
#include <gale/algorithms/morse_smale/paths_on_ranks.hpp>
#include <gale/base/error.hpp>
#include <gale/base/memory.hpp>
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

PathsOnRanks::PathsOnRanks(const PathSimplices& simplices)
    : simplices_(simplices), criticals_(static_cast<Id>(simplices.critical().size())) {
  together(ranks(), [&] { find_exits(); });
  while (jump()) {
  }
}

void PathsOnRanks::find_exits() {
  const auto& successors = simplices_.successors().in<HostMemory>();
  const auto elsewhere = by_rank(1, successors.extent(0), [&](Id i, const auto& visit) {
    if (successors(i) == DiscreteGradient::elsewhere) visit(0);
  });
  exits_.assign(elsewhere.members.data(), elsewhere.members.data() + elsewhere.members.extent(0));
  std::vector<Id> ends = simplices_.critical();
  ends.insert(ends.end(), exits_.begin(), exits_.end());
  ends_ = ends_here(simplices_.successors(), ends);
  for (const Id exit : exits_) stops_.push_back({simplices_.owner(exit), simplices_.global(exit)});
}

Id PathsOnRanks::end(Id simplex) const {
  const Id end = ends_(simplex);
  return end == path_outside ? no_id : place_of_end(end);
}

PathStop PathsOnRanks::final_stop(Id end) const {
  if (end == no_id) return {};
  if (is_exit(end)) return stops_[end - criticals_];
  return {PathStop::critical, simplices_.global(simplices_.critical()[end])};
}

Array<const Id, HostMemory> PathsOnRanks::places_of_ends() const {
  Array<SimplexKey, HostMemory> keys;
  Array<Id, HostMemory> critical_ends;  // those that end at a critical simplex
  together(ranks(), [&] {
    critical_ends = by_rank(1, ends(), [&](Id end, const auto& visit) {
                      if (final_stop(end).rank == PathStop::critical) visit(0);
                    }).members;
    keys = allocate<decltype(keys)>("GALE::end_keys", critical_ends.extent(0));
    parallel_for("GALE::end_keys", HostExecutionSpace(), critical_ends.extent(0), [&](Offset i) {
      keys(i) = {final_stop(critical_ends(i)).id, 0, 0};
    });
  });
  const KeyPlaces found = places_of_keys(ranks(), keys);
  Array<Id, HostMemory> places;
  together(ranks(), [&] {
    require_ids("minima or maxima of all ranks", found.count);
    places = allocate<Array<Id, HostMemory>>("GALE::places_of_ends", ends());
    fill("GALE::no_places", HostExecutionSpace(), places, no_id);
    parallel_for("GALE::places_of_ends", HostExecutionSpace(), critical_ends.extent(0),
                 [&](Offset i) { places(critical_ends(i)) = static_cast<Id>(found.places(i)); });
  });
  return places;
}

/// One round: each exit whose path goes on elsewhere learns from the rank where it is how it ends there. False, and
/// nothing done, if all have ended on all ranks.
bool PathsOnRanks::jump() {
  std::vector<Id> open;
  for (std::size_t i = 0; i < stops_.size(); ++i) {
    if (!stops_[i].is_end()) open.push_back(static_cast<Id>(i));
  }
  if (ranks().sum(static_cast<std::int64_t>(open.size())) == 0) return false;
  const auto next = ask<PathStop>(
      ranks(), "GALE::next_stops", static_cast<Offset>(open.size()), [&](Id i) { return stops_[open[i]].rank; },
      [&](Id i) { return stops_[open[i]].id; }, [&](GlobalId id) { return final_stop(end(simplices_.local(id))); });
  for (std::size_t i = 0; i < open.size(); ++i) stops_[open[i]] = next(i);
  ++rounds_;
  return true;
}

}  // namespace gale::detail
