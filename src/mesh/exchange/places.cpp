#include <algorithm>
#include <vector>

#include <gale/base/sort.hpp>
#include <gale/mesh/exchange/home_table.hpp>
#include <gale/mesh/exchange/messages.hpp>
#include <gale/mesh/exchange/places.hpp>

namespace gale::detail {

namespace {

struct IdCount {
  GlobalId id, count;
};

/// The different ones of numbers that ascend, each with how often it occurs.
std::vector<IdCount> counts_of_each(const Array<const std::uint64_t, HostMemory>& ascending) {
  std::vector<IdCount> counts;
  for (std::size_t i = 0; i < ascending.extent(0); ++i) {
    const auto number = static_cast<GlobalId>(ascending(i));
    if (counts.empty() || counts.back().id != number) counts.push_back({number, 0});
    ++counts.back().count;
  }
  return counts;
}

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

/// Sets places(i) to the one of each of the keys among those `distinct`, from `first` on.
void find_places(const Array<SimplexKey, HostMemory>& keys, const std::vector<SimplexKey>& distinct, GlobalId first,
                 const Array<GlobalId, HostMemory>& places) {
  const Offset count = keys.extent(0);
  for_parts("GALE::told_places", count, threads_for(count), [&](int, Offset begin, Offset end) {
    auto at = distinct.begin();
    for (Offset i = begin; i < end; ++i) {
      stop_if_asked_at(i);
      const SimplexKey& key = keys(i);
      if (i == begin || key < keys(i - 1)) at = distinct.begin();
      auto last = at;  // the key is in ever longer steps from where the one before was
      for (Offset step = 1; last != distinct.end() && *last < key; step *= 2) {
        at = last;
        last += std::min(step, distinct.end() - last);
      }
      at = std::lower_bound(at, last, key);
      places(i) = first + (at - distinct.begin());
    }
  });
}

}  // namespace

KeyPlaces places_of_keys(const Ranks& ranks, const Array<const SimplexKey, HostMemory>& keys) {
  const Offset count = keys.extent(0);
  const GlobalId greatest = -ranks.least(reduce_min("GALE::greatest_key", HostExecutionSpace(), count, GlobalId(0),
                                                    [&](Offset i) { return -keys(i)[0]; }));
  const GlobalId keys_a_home = greatest / ranks.size() + 1;
  Array<Id, HostMemory> members;
  const auto sent = collect_by_rank<SimplexKey>(
      ranks, "GALE::sent_keys", count, [&](Id i) { return keys(i)[0] / keys_a_home; }, [&](Id i) { return keys(i); },
      &members);
  const auto received = exchange_packed(ranks, "GALE::received_keys", sent);
  std::vector<SimplexKey> distinct;
  together(ranks, [&] { distinct = distinct_keys(received); });
  const auto here = static_cast<GlobalId>(distinct.size());
  const GlobalId first = ranks.sum_before(here);
  KeyPlaces found;
  found.count = ranks.sum(here);
  EntriesByRank<GlobalId> told;
  together(ranks, [&] {
    told = room_by_rank<GlobalId>("GALE::told_places", counts_of(received));
    find_places(received.entries, distinct, first, told.entries);
    found.places = allocate<Array<GlobalId, HostMemory>>("GALE::key_places", count);
  });
  const auto answers = exchange_packed(ranks, "GALE::answered_places", told);
  parallel_for("GALE::key_places", HostExecutionSpace(), count,
               [&](Offset i) { found.places(members(i)) = answers.entries(i); });
  return found;
}

Array<GlobalId, HostMemory> sums_before(const Ranks& ranks, const Array<const GlobalId, HostMemory>& ids,
                                        const Array<const GlobalId, HostMemory>& counts) {
  const Offset here = ids.extent(0);
  const Homes homes(ranks, ids);
  Array<Id, HostMemory> members;
  const auto sent = collect_by_rank<IdCount>(
      ranks, "GALE::sent_counts", here, [&](Id i) { return homes.of(ids(i)); },
      [&](Id i) {
        return IdCount{ids(i), counts(i)};
      },
      &members);
  const auto received = exchange_packed(ranks, "GALE::received_counts", sent);
  EntriesByRank<GlobalId> told;
  Array<GlobalId, HostMemory> sums;
  GlobalId sum = 0;
  together(ranks, [&] {
    told = room_by_rank<GlobalId>("GALE::told_sums", counts_of(received));
    const auto all = allocate<GlobalIds>("GALE::received_ids", received.count());
    parallel_for("GALE::received_ids", HostExecutionSpace(), all.extent(0),
                 [&](Offset i) { all(i) = received.entries(i).id; });
    const auto places = distinct_ids(all).places;
    for (std::size_t i = 0; i < places.extent(0); ++i) {
      told.entries(places(i)) = sum;
      sum += received.entries(places(i)).count;
    }
    sums = allocate<Array<GlobalId, HostMemory>>("GALE::sums_before", here + 1);
  });
  const GlobalId before = ranks.sum_before(sum);
  parallel_for("GALE::told_sums", HostExecutionSpace(), told.count(), [&](Offset i) { told.entries(i) += before; });
  const auto answers = exchange_packed(ranks, "GALE::answered_sums", told);
  parallel_for("GALE::sums_before", HostExecutionSpace(), here,
               [&](Offset i) { sums(members(i)) = answers.entries(i); });
  sums(here) = ranks.sum(sum);
  return sums;
}

Array<GlobalId, HostMemory> occurrences(const Ranks& ranks, const Array<const GlobalId, HostMemory>& all,
                                        const Array<const GlobalId, HostMemory>& asked) {
  const Homes homes(ranks, all);
  std::vector<IdCount> counts;
  together(ranks, [&] {
    const auto sorted = allocate<Array<std::uint64_t, HostMemory>>("GALE::sorted_numbers", all.extent(0));
    parallel_for("GALE::sorted_numbers", HostExecutionSpace(), all.extent(0),
                 [&](Offset i) { sorted(i) = static_cast<std::uint64_t>(all(i)); });
    const auto places = iota("GALE::number_places", HostExecutionSpace(), all.extent(0));
    stable_sort_by_key(HostExecutionSpace(), sorted, places);
    counts = counts_of_each(sorted);
  });
  const auto received =
      exchange_packed(ranks, "GALE::received_occurrences",
                      collect_by_rank<IdCount>(
                          ranks, "GALE::sent_occurrences", static_cast<Offset>(counts.size()),
                          [&](Id i) { return homes.of(counts[i].id); }, [&](Id i) { return counts[i]; }));
  GlobalIndex index;
  Array<GlobalId, HostMemory> sums;
  together(ranks, [&] {
    const auto ids = allocate<GlobalIds>("GALE::counted_ids", received.count());
    parallel_for("GALE::counted_ids", HostExecutionSpace(), ids.extent(0),
                 [&](Offset i) { ids(i) = received.entries(i).id; });
    index = GlobalIndex(distinct_ids(ids).ids);
    sums = Array<GlobalId, HostMemory>("GALE::occurrences", index.count());
    for (Offset i = 0; i < received.count(); ++i) sums(index.find(received.entries(i).id)) += received.entries(i).count;
  });
  return ask<GlobalId>(
      ranks, "GALE::found_occurrences", asked.extent(0), [&](Id i) { return homes.of(asked(i)); },
      [&](Id i) { return asked(i); },
      [&](GlobalId id) {
        const Id place = index.find(id);
        return place == no_id ? GlobalId(0) : sums(place);
      });
}

}  // namespace gale::detail
