#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include <gale/base/memory.hpp>
#include <gale/base/types.hpp>
#include <gale/distributed/together.hpp>

namespace gale::detail {

/// Entries by rank, to be sent to it or received from it: those of rank r are entries(begin[r]) to
/// entries(begin[r + 1] - 1).
template <class T>
struct Dealt {
  Array<T, HostMemory> entries;
  std::vector<Offset> begin;

  Offset count() const { return begin.back(); }
  Offset count(int rank) const { return begin[rank + 1] - begin[rank]; }
};

/// Room for so many entries by rank.
template <class T>
Dealt<T> dealt(const char* label, const std::vector<std::int64_t>& counts) {
  Dealt<T> all;
  all.begin.assign(counts.size() + 1, 0);
  std::partial_sum(counts.begin(), counts.end(), all.begin.begin() + 1);
  all.entries = allocate<Array<T, HostMemory>>(label, all.count());
  return all;
}

template <class T>
std::vector<std::int64_t> counts_of(const Dealt<T>& some) {
  std::vector<std::int64_t> counts(some.begin.size() - 1);
  std::adjacent_difference(some.begin.begin() + 1, some.begin.end(), counts.begin());
  return counts;
}

/// Sends each rank its entries into the room that it has for them; both know how many there are. Collective.
template <class T>
void exchange(const Communicator& ranks, const Dealt<T>& sent, const Dealt<T>& received) {
  const auto in_bytes = [](std::vector<Offset> begin) {
    for (Offset& at : begin) at *= static_cast<Offset>(sizeof(T));
    return begin;
  };
  ranks.exchange_bytes(reinterpret_cast<const char*>(sent.entries.data()), in_bytes(sent.begin),
                       reinterpret_cast<char*>(received.entries.data()), in_bytes(received.begin));
}

/// Sends each rank its entries, and returns what all have sent here. Collective.
template <class T>
Dealt<T> exchange(const Communicator& ranks, const char* label, const Dealt<T>& sent) {
  const auto counts = ranks.exchange_counts(counts_of(sent));
  Dealt<T> received;
  together(ranks, [&] { received = dealt<T>(label, counts); });
  exchange(ranks, sent, received);
  return received;
}

}  // namespace gale::detail
