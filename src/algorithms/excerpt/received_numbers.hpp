#pragma once

#include <vector>

#include <gale/base/parallel.hpp>
#include <gale/mesh/exchange/global_index.hpp>
#include <gale/mesh/exchange/messages.hpp>

namespace gale::detail {

/// What ranks have sent has a number each by its global id, which may have come from several.
template <class T>
class ReceivedNumbers {
 public:
  explicit ReceivedNumbers(const EntriesByRank<T>& received) : begin_(received.begin), number_(received.count()) {
    const auto all = allocate<GlobalIds>("GALE::received_ids", received.count());
    parallel_for("GALE::received_ids", HostExecutionSpace(), received.count(),
                 [&](Offset i) { all(i) = received.entries(i).id; });
    const DistinctIds distinct = distinct_ids(all);
    ids = distinct.ids;
    first = distinct.places;
    if (count() == received.count()) {  // no id came twice: each has its place
      parallel_for("GALE::number_received", HostExecutionSpace(), count(),
                   [&](Offset i) { number_[first(i)] = static_cast<Id>(i); });
      return;
    }
    const GlobalIndex index(ids);
    parallel_for("GALE::number_received", HostExecutionSpace(), received.count(),
                 [&](Offset i) { number_[i] = index.find(all(i)); });
  }

  Id count() const { return static_cast<Id>(ids.extent(0)); }

  /// The number of what a rank has sent at a place.
  Id of(int rank, Id place) const { return number_[begin_[rank] + place]; }

  /// Numbers by rank.
  const std::vector<Offset>& begin() const { return begin_; }
  Id operator[](Offset i) const { return number_[i]; }

  GlobalIds ids;                ///< by number
  Array<Id, HostMemory> first;  ///< where among what was received each is first

 private:
  std::vector<Offset> begin_;
  std::vector<Id> number_;
};

}  // namespace gale::detail
