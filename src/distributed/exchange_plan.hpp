#pragma once

#include <gale/base/memory.hpp>
#include <gale/base/types.hpp>
#include <gale/distributed/deal.hpp>

namespace gale::detail {

/// Which values this rank takes from which others, and gives to them: made once, then each exchange is one message from
/// rank to rank.
class ExchangePlan {
 public:
  ExchangePlan() = default;

  /// Where one rank has all: each slot's value is in its place already.
  static ExchangePlan of_one_rank(Offset count) {
    ExchangePlan plan;
    plan.same_ = count;
    return plan;
  }

  /// For each of `slots` of this rank the value of what the rank source(slot) knows by key(slot). place(key) is where
  /// that rank will have the value among those that it gives from. Collective.
  template <class Source, class Key, class Place>
  ExchangePlan(const Communicator& ranks, const Array<const Id, HostMemory>& slots, const Source& source,
               const Key& key, const Place& place);

  /// Fills to[slot] for each of the slots with from[place]. Collective.
  template <class T>
  void operator()(const Communicator& ranks, const T* from, T* to) const {
    if (same_ > 0) {
      parallel_for("GALE::kept_values", HostSpace(), same_, [&](Offset i) { to[i] = from[i]; });
      return;
    }
    if (taken_counts_.empty()) return;  // nothing is exchanged
    Dealt<T> given, taken;
    together(ranks, [&] {
      given = dealt<T>("GALE::given_values", counts_of(given_));
      parallel_for("GALE::given_values", HostSpace(), given.count(),
                   [&](Offset i) { given.entries(i) = from[given_.entries(i)]; });
      taken = dealt<T>("GALE::taken_values", taken_counts_);
    });
    exchange(ranks, given, taken);
    parallel_for("GALE::kept_values", HostSpace(), kept_slots_.extent(0),
                 [&](Offset i) { to[kept_slots_(i)] = from[kept_places_(i)]; });
    parallel_for("GALE::taken_values", HostSpace(), taken.count(), [&](Offset i) { to[slots_(i)] = taken.entries(i); });
  }

 private:
  Offset same_ = 0;                                 ///< of one rank: slots that are places
  Array<Id, HostMemory> kept_slots_, kept_places_;  ///< of values that this rank has itself
  Dealt<Id> given_;                                 ///< places, by the rank that takes them
  std::vector<std::int64_t> taken_counts_;
  Array<Id, HostMemory> slots_;  ///< in the order in which values come
};

template <class Source, class Key, class Place>
ExchangePlan::ExchangePlan(const Communicator& ranks, const Array<const Id, HostMemory>& slots, const Source& source,
                           const Key& key, const Place& place) {
  Array<Id, HostMemory> others;
  together(ranks, [&] {
    const int here = ranks.rank();
    const ByRank groups =
        by_rank(2, slots.extent(0), [&](Id i, const auto& visit) { visit(source(slots(i)) != here); });
    kept_slots_ = allocate<Array<Id, HostMemory>>("GALE::kept_slots", groups.begin[1]);
    kept_places_ = allocate<Array<Id, HostMemory>>("GALE::kept_places", groups.begin[1]);
    parallel_for("GALE::kept_slots", HostSpace(), groups.begin[1], [&](Offset i) {
      kept_slots_(i) = slots(groups.members(i));
      kept_places_(i) = place(GlobalId(key(kept_slots_(i))));
    });
    others = allocate<Array<Id, HostMemory>>("GALE::wanted_slots", groups.begin[2] - groups.begin[1]);
    parallel_for("GALE::wanted_slots", HostSpace(), others.extent(0),
                 [&](Offset i) { others(i) = slots(groups.members(groups.begin[1] + i)); });
  });
  const auto asked = deal<GlobalId>(
      ranks, "GALE::wanted_values", others.extent(0), [&](Id i) { return source(others(i)); },
      [&](Id i) { return GlobalId(key(others(i))); }, &slots_);
  parallel_for("GALE::wanted_slots", HostSpace(), slots_.extent(0), [&](Offset i) { slots_(i) = others(slots_(i)); });
  taken_counts_ = counts_of(asked);
  const auto keys = exchange(ranks, "GALE::wanted_keys", asked);
  together(ranks, [&] {
    given_ = dealt<Id>("GALE::given_places", counts_of(keys));
    parallel_for("GALE::given_places", HostSpace(), keys.count(),
                 [&](Offset i) { given_.entries(i) = place(keys.entries(i)); });
  });
}

}  // namespace gale::detail
