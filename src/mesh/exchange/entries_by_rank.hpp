#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <gale/base/memory.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/types.hpp>

// What goes to each rank, or has come from it.

namespace gale::detail {

/// Entries by rank, to be sent to it or received from it: those of rank r are entries(begin[r]) to
/// entries(begin[r + 1] - 1).
template <class T>
struct EntriesByRank {
  Array<T, HostMemory> entries;
  std::vector<Offset> begin;

  Offset count() const { return begin.back(); }
  Offset count(int rank) const { return begin[rank + 1] - begin[rank]; }

  /// The rank of the entry at a place.
  int rank_of(Offset at) const {
    return static_cast<int>(std::upper_bound(begin.begin(), begin.end(), at) - begin.begin()) - 1;
  }
};

/// Room for so many entries by rank.
template <class T>
EntriesByRank<T> room_by_rank(const char* label, const std::vector<std::int64_t>& counts) {
  EntriesByRank<T> all;
  all.begin.assign(counts.size() + 1, 0);
  std::partial_sum(counts.begin(), counts.end(), all.begin.begin() + 1);
  all.entries = allocate<Array<T, HostMemory>>(label, all.count());
  return all;
}

/// Room for entries that come from other ranks. MPI writes them by one thread, which would wait for the system's pages
/// as long as for what comes: where there are many, all threads have it give them.
template <class T>
EntriesByRank<T> room_to_receive(const char* label, const std::vector<std::int64_t>& counts) {
  constexpr std::size_t many_bytes = std::size_t(1) << 20;
  const EntriesByRank<T> all = room_by_rank<T>(label, counts);
  const std::size_t bytes = static_cast<std::size_t>(all.count()) * sizeof(T);
  if (bytes >= many_bytes) expect_writes(all.entries.data(), bytes, threads_for(all.count()));
  return all;
}

/// Calls visit(rank, entry) for all that was received.
template <class T, class Visit>
void for_each_received(const EntriesByRank<T>& received, const Visit& visit) {
  for (int rank = 0; rank + 1 < static_cast<int>(received.begin.size()); ++rank) {
    for (Offset i = received.begin[rank]; i < received.begin[rank + 1]; ++i) visit(rank, received.entries(i));
  }
}

template <class T>
std::vector<std::int64_t> counts_of(const EntriesByRank<T>& some) {
  std::vector<std::int64_t> counts(some.begin.size() - 1);
  std::adjacent_difference(some.begin.begin() + 1, some.begin.end(), counts.begin());
  return counts;
}

/// Groups the items 0..items-1, ascending: visit_ranks(item, visit) calls visit(rank) for each rank of an item, the
/// same ones each time. Unlike group_by it is for few groups of many items: no two threads count in one place, and an
/// item that has one rank, as most have, is asked once.
template <class VisitRanks>
EntriesByRank<Id> group_by_rank(int ranks, Offset items, const VisitRanks& visit_ranks) {
  constexpr std::uint8_t ask_again = 255;
  const auto only_rank = allocate<Array<std::uint8_t, HostMemory>>("GALE::only_rank", items);
  auto places = of_parts("GALE::count_by_rank", items, [&](Offset first, Offset last) {
    std::vector<Offset> counts(ranks, 0);
    for (Offset i = first; i < last; ++i) {
      int ranks_of_item = 0, last_rank = 0;
      visit_ranks(static_cast<Id>(i), [&](int rank) {
        ++counts[rank];
        ++ranks_of_item;
        last_rank = rank;
      });
      only_rank(i) = ranks_of_item == 1 && last_rank < ask_again ? static_cast<std::uint8_t>(last_rank) : ask_again;
    }
    return counts;
  });
  EntriesByRank<Id> groups{{}, begins_of_parts<Offset>(places, ranks)};
  groups.entries = allocate<Array<Id, HostMemory>>("GALE::items_by_rank", groups.count());
  for_parts("GALE::fill_by_rank", items, static_cast<int>(places.size()), [&](int part, Offset first, Offset last) {
    std::vector<Offset>& next = places[part];
    for (Offset i = first; i < last; ++i) {
      const auto put = [&](int rank) { groups.entries(next[rank]++) = static_cast<Id>(i); };
      only_rank(i) == ask_again ? visit_ranks(static_cast<Id>(i), put) : put(only_rank(i));
    }
  });
  return groups;
}

/// For each of so many ranks the entries entry_of(i) of those items i in 0..items-1 whose rank_of(i) it is, ascending.
/// `members` becomes the items in the order of the entries.
template <class T, class RankOf, class EntryOf>
EntriesByRank<T> entries_by_rank(int ranks, const char* label, Offset items, const RankOf& rank_of,
                                 const EntryOf& entry_of, Array<Id, HostMemory>* members = nullptr) {
  const EntriesByRank<Id> groups =
      group_by_rank(ranks, items, [&](Id i, const auto& visit) { visit(static_cast<int>(rank_of(i))); });
  if (members != nullptr) *members = groups.entries;
  return {tabulated<T>(label, items, [&](Offset k) { return entry_of(groups.entries(k)); }), groups.begin};
}

/// Entries that have their ranks before them, by these.
template <class T>
EntriesByRank<T> entries_by_rank(int ranks, const char* label, const std::vector<std::pair<int, T>>& entries) {
  return entries_by_rank<T>(
      ranks, label, static_cast<Offset>(entries.size()), [&](Id i) { return entries[i].first; },
      [&](Id i) { return entries[i].second; });
}

}  // namespace gale::detail
