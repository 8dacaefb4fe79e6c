#include <gale/distributed/deal.hpp>
#include <gale/distributed/key_places.hpp>
#include <gale/distributed/places_of_ends.hpp>

namespace gale::detail {

Array<const GlobalId, HostMemory> places_of_ends(const Communicator& ranks, const DistributedPaths& paths) {
  Array<SimplexKey, HostMemory> keys;
  Array<Id, HostMemory> ends;  // those that end at a critical simplex
  together(ranks, [&] {
    ends = by_rank(1, paths.ends(), [&](Id end, const auto& visit) {
             if (paths.final_stop(end).rank == Stop::critical) visit(0);
           }).members;
    keys = allocate<decltype(keys)>("GALE::end_keys", ends.extent(0));
    parallel_for("GALE::end_keys", HostExecutionSpace(), ends.extent(0), [&](Offset i) {
      keys(i) = {paths.final_stop(ends(i)).id, 0, 0};
    });
  });
  const KeyPlaces found = places_of_keys(ranks, keys);
  Array<GlobalId, HostMemory> places;
  together(ranks, [&] {
    places = allocate<Array<GlobalId, HostMemory>>("GALE::places_of_ends", paths.ends());
    fill("GALE::no_places", HostExecutionSpace(), places, GlobalId(-1));
    parallel_for("GALE::places_of_ends", HostExecutionSpace(), ends.extent(0),
                 [&](Offset i) { places(ends(i)) = found.places(i); });
  });
  return places;
}

}  // namespace gale::detail
