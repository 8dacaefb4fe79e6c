#include <algorithm>
#include <utility>
#include <vector>

#include <gale/base/ordered.hpp>
#include <gale/base/sort.hpp>
#include <gale/mesh/exchange/home_table.hpp>
#include <gale/mesh/exchange/messages.hpp>
#include <gale/mesh/exchange/places.hpp>

namespace gale::detail {

namespace {

struct IdCount {
  GlobalId id, count;
};

/// The different keys that were received, ascending. Mostly each rank's ascend already.
std::vector<SimplexKey> distinct_keys(const EntriesByRank<SimplexKey>& received) {
  const SimplexKey* const from = received.entries.data();
  std::vector<SimplexKey> keys(from, from + received.count());
  bool all_ascend = true;
  for (std::size_t rank = 0; rank + 1 < received.begin.size() && all_ascend; ++rank)
    all_ascend = std::is_sorted(from + received.begin[rank], from + received.begin[rank + 1]);
  if (all_ascend) {
    merge_runs(keys.begin(), received.begin);
  } else {
    parallel_sort("GALE::sort_keys", keys.begin(), keys.end());
  }
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return keys;
}

/// Sets places(i) to the one of each of the keys among those `distinct`.
void find_places(const Array<SimplexKey, HostMemory>& keys, const std::vector<SimplexKey>& distinct,
                 const Array<GlobalId, HostMemory>& places) {
  const Offset count = keys.extent(0);
  for_parts("GALE::told_places", count, threads_for(count), [&](int, Offset begin, Offset end) {
    auto at = distinct.begin();
    for (Offset i = begin; i < end; ++i) {
      stop_if_asked_at(i);
      const SimplexKey& key = keys(i);
      if (i == begin || key < keys(i - 1)) at = distinct.begin();
      at = gallop(at, distinct.end(), [&](const auto& place) { return *place < key; });
      places(i) = at - distinct.begin();
    }
  });
}

/// Makes places of those that homes have given, each from 0 on: the homes follow one another. `here` is how many this
/// one has, home_of(i) the home that has given the i-th. Collective.
template <class HomeOf>
PlacesOfAll places_by_home(const Ranks& ranks, GlobalId here, const Array<GlobalId, HostMemory>& places,
                           const HomeOf& home_of) {
  std::vector<GlobalId> first = ranks.all(here);
  GlobalId count = 0;
  for (GlobalId& of_home : first) count += std::exchange(of_home, count);
  parallel_for("GALE::places_by_home", HostExecutionSpace(), places.extent(0),
               [&](Offset i) { places(i) += first[home_of(static_cast<Id>(i))]; });
  return {places, count};
}

}  // namespace

PlacesOfAll places_of_keys(const Ranks& ranks, const Array<const SimplexKey, HostMemory>& keys) {
  const Homes homes(ranks, keys.extent(0), [&](Offset i) { return keys(i)[0]; });
  const auto home_of = [&](Id i) { return homes.of(keys(i)[0]); };
  GlobalId here = 0;  // different ones
  const auto places = ask_for_all<GlobalId>(
      ranks, "GALE::key_places", keys.extent(0), home_of, [&](Id i) { return keys(i); },
      [&](const auto& asked, const auto& answers) {
        const std::vector<SimplexKey> distinct = distinct_keys(asked);
        find_places(asked.entries, distinct, answers);
        here = static_cast<GlobalId>(distinct.size());
      });
  return places_by_home(ranks, here, places, home_of);
}

PlacesOfAll sums_before(const Ranks& ranks, const Array<const GlobalId, HostMemory>& ids,
                        const Array<const GlobalId, HostMemory>& counts) {
  const Homes homes(ranks, ids.extent(0), ids);
  const auto home_of = [&](Id i) { return homes.of(ids(i)); };
  GlobalId here = 0;  // the sum of counts
  const auto sums = ask_for_all<GlobalId>(
      ranks, "GALE::sums_before", ids.extent(0), home_of,
      [&](Id i) {
        return IdCount{ids(i), counts(i)};
      },
      [&](const auto& asked, const auto& answers) {
        const auto all =
            tabulated<GlobalId>("GALE::received_ids", asked.count(), [&](Offset i) { return asked.entries(i).id; });
        const auto by_id = distinct_ids(all).places;
        for (std::size_t i = 0; i < by_id.extent(0); ++i) {
          answers(by_id(i)) = here;
          here += asked.entries(by_id(i)).count;
        }
      });
  return places_by_home(ranks, here, sums, home_of);
}

Array<GlobalId, HostMemory> occurrences(const Ranks& ranks, const Array<const GlobalId, HostMemory>& all,
                                        const Array<const GlobalId, HostMemory>& asked) {
  std::vector<GlobalId> numbers, counts;  // of different numbers here
  together(ranks, [&] {
    const auto sorted = tabulated<std::uint64_t>("GALE::sorted_numbers", all.extent(0), all);
    const auto places = iota("GALE::number_places", HostExecutionSpace(), all.extent(0));
    stable_sort_by_key(HostExecutionSpace(), sorted, places);
    for (std::size_t i = 0; i < sorted.extent(0); ++i) {
      const auto number = static_cast<GlobalId>(sorted(i));
      if (numbers.empty() || numbers.back() != number) {
        numbers.push_back(number);
        counts.push_back(0);
      }
      ++counts.back();
    }
  });
  const HomeTable<GlobalId> sums(
      ranks, Array<const GlobalId, HostMemory>(numbers.data(), numbers.size()), [&](Id i) { return counts[i]; },
      [](int, GlobalId count) { return count; }, [](int, GlobalId count, GlobalId& sum) { sum += count; });
  return sums.find(ranks, asked, 0);
}

}  // namespace gale::detail
