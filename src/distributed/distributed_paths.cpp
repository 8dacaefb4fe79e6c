#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/morse_smale/jump.hpp>
#include <gale/base/worker_or_host.hpp>
#include <gale/distributed/deal.hpp>
#include <gale/distributed/distributed_paths.hpp>

namespace gale::detail {

namespace {

/// The ends of paths inside one rank: see jump().
Array<const Id, HostMemory> local_ends(const Mirrored<Id>& successors, const std::vector<Id>& ends) {
  return in_worker_or_host_space(successors.on_device(), [&](const auto& space) -> Array<const Id, HostMemory> {
    const auto next = with_ends(space, successors, ends);
    jump(space, next);
    space.fence();
    return on_host(next);
  });
}

}  // namespace

DistributedPaths::DistributedPaths(const Communicator& ranks, const PathSimplices& simplices)
    : simplices_(simplices), criticals_(static_cast<Id>(simplices.critical->size())) {
  together(ranks, [&] { find_exits(); });
  while (jump(ranks)) {
  }
}

void DistributedPaths::find_exits() {
  const auto& successors = simplices_.successors->in<HostMemory>();
  const auto elsewhere = by_rank(1, successors.extent(0), [&](Id i, const auto& visit) {
    if (successors(i) == DiscreteGradient::elsewhere) visit(0);
  });
  exits_.assign(elsewhere.members.data(), elsewhere.members.data() + elsewhere.members.extent(0));
  std::vector<Id> ends = *simplices_.critical;
  ends.insert(ends.end(), exits_.begin(), exits_.end());
  ends_ = local_ends(*simplices_.successors, ends);
  std::vector<Stop> first(exits_.size());
  for (std::size_t i = 0; i < exits_.size(); ++i)
    first[i] = {simplices_.owner(exits_[i]), simplices_.global(exits_[i])};
  stops_.push_back(std::move(first));
}

Id DistributedPaths::end(Id simplex) const {
  const Id end = ends_(simplex);
  return end == path_outside ? no_id : place_of_end(end);
}

Stop DistributedPaths::final_stop(Id end) const {
  if (end == no_id) return {};
  if (is_exit(end)) return stops_.back()[exit_of(end)];
  return {Stop::critical, simplices_.global((*simplices_.critical)[end])};
}

/// One round: each exit whose path goes on elsewhere learns from the rank where it is how it ends there. False, and
/// nothing done, if all have ended on all ranks.
bool DistributedPaths::jump(const Communicator& ranks) {
  const std::vector<Stop>& stops = stops_.back();
  std::vector<Id> open;
  for (std::size_t i = 0; i < stops.size(); ++i) {
    if (!stops[i].is_end()) open.push_back(static_cast<Id>(i));
  }
  if (ranks.sum(static_cast<std::int64_t>(open.size())) == 0) return false;
  Array<Id, HostMemory> members;
  const auto asked = deal<GlobalId>(
      ranks, "GALE::open_paths", static_cast<Offset>(open.size()), [&](Id i) { return stops[open[i]].rank; },
      [&](Id i) { return stops[open[i]].id; }, &members);
  const auto answers = answer<Stop>(ranks, "GALE::next_stops", asked,
                                    [&](GlobalId id) { return final_stop(end(simplices_.local(id))); });
  std::vector<Stop> further = stops;
  for (Offset i = 0; i < answers.count(); ++i) further[open[members(i)]] = answers.entries(i);
  stops_.push_back(std::move(further));
  return true;
}

}  // namespace gale::detail
