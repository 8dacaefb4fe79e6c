#include <gale/base/radix_sort.hpp>
#include <gale/distributed/sums_by_id.hpp>

namespace gale::detail {

namespace {

struct Count {
  GlobalId id, count;
};

/// The different ones of numbers that ascend, each with how often it occurs.
std::vector<Count> counted(const Array<const std::uint64_t, HostMemory>& ascending) {
  std::vector<Count> counts;
  for (std::size_t i = 0; i < ascending.extent(0); ++i) {
    const auto number = static_cast<GlobalId>(ascending(i));
    if (counts.empty() || counts.back().id != number) counts.push_back({number, 0});
    ++counts.back().count;
  }
  return counts;
}

}  // namespace

Array<GlobalId, HostMemory> sums_before(const Communicator& ranks, const Array<const GlobalId, HostMemory>& ids,
                                        const Array<const GlobalId, HostMemory>& counts) {
  const Offset here = ids.extent(0);
  const Homes homes(ranks, ids);
  Array<Id, HostMemory> members;
  const auto sent = deal<Count>(
      ranks, "GALE::sent_counts", here, [&](Id i) { return homes.of(ids(i)); },
      [&](Id i) {
        return Count{ids(i), counts(i)};
      },
      &members);
  const auto received = exchange(ranks, "GALE::received_counts", sent);
  Dealt<GlobalId> told, answers;
  Array<GlobalId, HostMemory> sums;
  GlobalId sum = 0;
  together(ranks, [&] {
    told = dealt<GlobalId>("GALE::told_sums", counts_of(received));
    const auto all = allocate<GlobalIds>("GALE::received_ids", received.count());
    parallel_for("GALE::received_ids", HostExecutionSpace(), all.extent(0),
                 [&](Offset i) { all(i) = received.entries(i).id; });
    const auto places = distinct_ids(all).places;
    for (std::size_t i = 0; i < places.extent(0); ++i) {
      told.entries(places(i)) = sum;
      sum += received.entries(places(i)).count;
    }
    answers = dealt<GlobalId>("GALE::answered_sums", counts_of(sent));
    sums = allocate<Array<GlobalId, HostMemory>>("GALE::sums_before", here + 1);
  });
  const GlobalId before = ranks.sum_before(sum);
  parallel_for("GALE::told_sums", HostExecutionSpace(), told.count(), [&](Offset i) { told.entries(i) += before; });
  exchange(ranks, told, answers);
  parallel_for("GALE::sums_before", HostExecutionSpace(), here,
               [&](Offset i) { sums(members(i)) = answers.entries(i); });
  sums(here) = ranks.sum(sum);
  return sums;
}

Array<GlobalId, HostMemory> occurrences(const Communicator& ranks, const Array<const GlobalId, HostMemory>& all,
                                        const Array<const GlobalId, HostMemory>& asked) {
  const Homes homes(ranks, all);
  std::vector<Count> counts;
  together(ranks, [&] {
    const auto sorted = allocate<Array<std::uint64_t, HostMemory>>("GALE::sorted_numbers", all.extent(0));
    parallel_for("GALE::sorted_numbers", HostExecutionSpace(), all.extent(0),
                 [&](Offset i) { sorted(i) = static_cast<std::uint64_t>(all(i)); });
    const auto places = iota("GALE::number_places", HostExecutionSpace(), all.extent(0));
    stable_sort_by_key(HostExecutionSpace(), sorted, places);
    counts = counted(sorted);
  });
  const auto received = exchange(ranks, "GALE::received_occurrences",
                                 deal<Count>(
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
  Array<Id, HostMemory> members;
  const auto questions = deal<GlobalId>(
      ranks, "GALE::asked_numbers", asked.extent(0), [&](Id i) { return homes.of(asked(i)); },
      [&](Id i) { return asked(i); }, &members);
  const auto answers = answer<GlobalId>(ranks, "GALE::told_occurrences", questions, [&](GlobalId id) {
    const Id place = index.find(id);
    return place == no_id ? GlobalId(0) : sums(place);
  });
  Array<GlobalId, HostMemory> found;
  together(ranks, [&] {
    found = allocate<Array<GlobalId, HostMemory>>("GALE::found_occurrences", asked.extent(0));
    parallel_for("GALE::found_occurrences", HostExecutionSpace(), asked.extent(0),
                 [&](Offset k) { found(members(k)) = answers.entries(k); });
  });
  return found;
}

}  // namespace gale::detail
