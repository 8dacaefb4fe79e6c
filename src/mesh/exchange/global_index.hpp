#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gale/base/bits.hpp>
#include <gale/base/parallel.hpp>
#include <gale/export.hpp>

namespace gale::detail {

using GlobalIds = Array<GlobalId, HostMemory>;

/// Global ids, ascending, none twice; and for each the place where it stood first among those that it was made from.
struct DistinctIds {
  GlobalIds ids;
  Array<Id, HostMemory> places;
};

/// On all host threads. O(n) if they ascend already, else a sort. Ids are 0 or more.
GALE_EXPORT DistinctIds distinct_ids(const Array<const GlobalId, HostMemory>& ids);

/// Sorts ids, and drops those that repeat others. O(n) where they lie densely.
GALE_EXPORT void keep_distinct(std::vector<GlobalId>& ids);

/// What keep_distinct leaves of some ids, in an array with that label.
GALE_EXPORT GlobalIds distinct_of(const std::string& label, std::vector<GlobalId> ids);

/// Finds the places of global ids among some that ascend: by bits, one for each id between the least and the greatest,
/// where these take no more than 16 bytes an id, else by bisection among the few that have the same leading bits; where
/// there are many lookups, by a table.
class GALE_EXPORT GlobalIndex {
 public:
  /// Whether so many are looked up that a table of places is worth its memory, 4 bytes for each id between the least
  /// and the greatest. There is none where that is more than 16 bytes an id.
  enum class Lookups { some, many };

  GlobalIndex() = default;

  /// Takes ids that ascend, none twice, at most 2^31 - 1 of them.
  explicit GlobalIndex(const Array<const GlobalId, HostMemory>& ascending, Lookups lookups = Lookups::some);

  /// no_id if it isn't there. By any thread.
  Id find(GlobalId id) const {
    const auto at = static_cast<std::uint64_t>(id) - first_;
    if (places_.extent(0) != 0) return at < places_.extent(0) ? places_(at) : no_id;
    if (words_.extent(0) == 0) return find_in_bucket(id);
    if (at >> 6 >= words_.extent(0)) return no_id;
    const CountedWord& word = words_(at >> 6);
    const int place = static_cast<int>(at & 63);
    return word.has(place) ? word.rank(place) : no_id;
  }

  Offset count() const { return ids_.extent(0); }
  GlobalId operator[](Offset place) const { return ids_(place); }
  const Array<const GlobalId, HostMemory>& ids() const { return ids_; }

 private:
  void mark_in_words(std::uint64_t words);
  void divide(std::uint64_t span);
  Id find_in_bucket(GlobalId id) const;

  std::uint64_t bucket(GlobalId id) const { return (static_cast<std::uint64_t>(id) - first_) >> shift_; }

  Array<const GlobalId, HostMemory> ids_;
  std::uint64_t first_ = 0;               ///< the least id
  Array<CountedWord, HostMemory> words_;  ///< bit id - first is set where an id is there
  Array<Id, HostMemory> places_;          ///< the table, from the least id on: no_id where there is none
  Array<Id, HostMemory> begin_;           ///< else of each bucket, and their end
  int shift_ = 0;  ///< ids that are alike but for so many last bits, from the least one on, share a bucket
};

/// Calls visit(i, place) for each of `some`, with its place among these and `others` together: all ascend, none is
/// there twice. On all host threads.
template <class Visit>
void visit_merged(const GlobalIds& some, const GlobalIds& others, const Visit& visit) {
  const Offset count = some.extent(0), other_count = others.extent(0);
  for_parts("GALE::merge_ids", count, threads_for(count), [&](int, Offset first, Offset last) {
    if (first == last) return;
    Offset less = std::lower_bound(others.data(), others.data() + other_count, some(first)) - others.data();
    for (Offset i = first; i < last; ++i) {
      while (less < other_count && others(less) < some(i)) ++less;
      visit(i, i + less);
    }
  });
}

/// Ids met lately, so that those which neighbours share are mostly taken once.
class RecentIds {
 public:
  /// Whether it was met lately; from now on it was. An id is 0 or more.
  bool met(GlobalId id) {
    GlobalId& last = last_[static_cast<std::size_t>(id) % last_.size()];
    const bool was = last == id;
    last = id;
    return was;
  }

 private:
  std::vector<GlobalId> last_ = std::vector<GlobalId>(4096, -1);  ///< by the lowest bits
};

/// The ids that `index` lacks among those that visit(i, offer) offers for i in 0..n-1: ascending, none twice.
template <class Visit>
GlobalIds missing_ids(const GlobalIndex& index, Offset n, const Visit& visit) {
  auto missing = of_parts("GALE::missing_ids", n, [&](Offset first, Offset last) {
    std::vector<GlobalId> mine;
    RecentIds recent;
    for (Offset i = first; i < last; ++i) {
      visit(i, [&](GlobalId id) {
        if (!recent.met(id) && index.find(id) == no_id) mine.push_back(id);
      });
    }
    keep_distinct(mine);
    return mine;
  });
  return distinct_of("GALE::missing_ids", concatenated(std::move(missing)));
}

}  // namespace gale::detail
