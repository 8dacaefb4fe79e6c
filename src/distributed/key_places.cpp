#include <algorithm>
#include <vector>

#include <gale/base/parallel_sort.hpp>
#include <gale/distributed/deal.hpp>
#include <gale/distributed/key_places.hpp>

namespace gale::detail {

KeyPlaces places_of_keys(const Communicator& ranks, const Array<const SimplexKey, HostMemory>& keys) {
  const Offset count = keys.extent(0);
  const GlobalId greatest = -ranks.least(reduce_min("GALE::greatest_key", HostExecutionSpace(), count, GlobalId(0),
                                                    [&](Offset i) { return -keys(i)[0]; }));
  const GlobalId keys_a_home = greatest / ranks.size() + 1;
  Array<Id, HostMemory> members;
  const auto sent = deal<SimplexKey>(
      ranks, "GALE::sent_keys", count, [&](Id i) { return keys(i)[0] / keys_a_home; }, [&](Id i) { return keys(i); },
      &members);
  const auto received = exchange(ranks, "GALE::received_keys", sent);
  std::vector<SimplexKey> distinct;
  together(ranks, [&] {
    distinct.assign(received.entries.data(), received.entries.data() + received.count());
    parallel_sort("GALE::sort_keys", distinct.begin(), distinct.end());
    distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  });
  const auto here = static_cast<GlobalId>(distinct.size());
  const GlobalId first = ranks.sum_before(here);
  KeyPlaces found;
  found.count = ranks.sum(here);
  Dealt<GlobalId> told, answers;
  together(ranks, [&] {
    told = dealt<GlobalId>("GALE::told_places", counts_of(received));
    parallel_for("GALE::told_places", HostExecutionSpace(), told.count(), [&](Offset i) {
      told.entries(i) =
          first + (std::lower_bound(distinct.begin(), distinct.end(), received.entries(i)) - distinct.begin());
    });
    answers = dealt<GlobalId>("GALE::answered_places", counts_of(sent));
    found.places = allocate<Array<GlobalId, HostMemory>>("GALE::key_places", count);
  });
  exchange(ranks, told, answers);
  parallel_for("GALE::key_places", HostExecutionSpace(), count,
               [&](Offset i) { found.places(members(i)) = answers.entries(i); });
  return found;
}

}  // namespace gale::detail
