#pragma once

#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include <gale/base/memory.hpp>
#include <gale/base/momentary.hpp>
#include <gale/base/transfer.hpp>
#include <gale/base/types.hpp>
#include <gale/mesh/exchange/messages.hpp>
#include <gale/mesh/intervals.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale::detail {

/// Writes each value to its slot.
template <class T, class Memory>
struct WriteToSlots {
  T* to;
  Array<const Id, Memory> slots;
  Array<const T, Memory> values;

  KOKKOS_FUNCTION void operator()(Offset i) const { to[slots(i)] = values(i); }
};

/// Which values this rank takes from which others, and gives to them: made once, then each exchange is one message from
/// rank to rank.
class ExchangePlan {
 public:
  /// Values of this rank's own that follow one another: that of slot + i is at place + i.
  struct Run {
    Offset slot = 0, place = 0, count = 0;
  };

  ExchangePlan() = default;

  /// Where one rank has all: each slot's value is in its place already.
  static ExchangePlan of_one_rank(Offset count) {
    ExchangePlan plan;
    plan.run_ = {0, 0, count};
    return plan;
  }

  /// Where ranks give one another intervals that all know: of this rank's places, by the rank that takes them, and of
  /// its slots, by the rank that gives them; empty ones for itself, whose own values are those of `run`. Sends nothing.
  static ExchangePlan of_intervals(const Run& run, const std::vector<Interval>& given,
                                   const std::vector<Interval>& taken) {
    const auto entries_of = [](const char* label, const std::vector<Interval>& intervals) {
      std::vector<std::int64_t> counts;
      for (const Interval& interval : intervals) counts.push_back(interval.size());
      const auto all = room_by_rank<Id>(label, counts);
      for (std::size_t rank = 0; rank < intervals.size(); ++rank)
        std::iota(all.entries.data() + all.begin[rank], all.entries.data() + all.begin[rank + 1],
                  intervals[rank].first);
      return all;
    };
    ExchangePlan plan;
    plan.run_ = run;
    plan.given_ = entries_of("GALE::given_places", given);
    const auto slots = entries_of("GALE::taken_slots", taken);
    plan.taken_counts_ = counts_of(slots);
    plan.slots_ = slots.entries;
    return plan;
  }

  /// For the i-th of `slots` of this rank the value of what the rank source(i) knows by key(i). place(key) is where
  /// that rank will have the value among those that it gives from. Beside them those of `run`, of none of which it has
  /// a slot. Collective.
  template <class Source, class Key, class Place>
  ExchangePlan(const Ranks& ranks, const Run& run, const Array<const Id, HostMemory>& slots, const Source& source,
               const Key& key, const Place& place);

  /// The plan by which other ranks take the same values from the slots that this rank's run has brought them to. It
  /// gives none but those of its run.
  ExchangePlan between_slots() const {
    ExchangePlan plan = *this;
    plan.run_ = {};
    plan.given_.entries = tabulated<Id>("GALE::given_slots", given_.entries.extent(0), [&](Offset i) {
      return static_cast<Id>(given_.entries(i) - run_.place + run_.slot);
    });
    return plan;
  }

  /// This rank's own values that follow one another.
  const Run& run() const { return run_; }

  /// Whether the values of all slots are in their places already.
  bool keeps_all() const { return taken_counts_.empty() && run_.slot == 0 && run_.place == 0; }

  /// The values that other ranks give: each of these has value_of(place) for what it gives. Collective.
  template <class T, class ValueOf>
  EntriesByRank<T> fetch(const Ranks& ranks, const ValueOf& value_of) const {
    Array<T, HostMemory> values;
    if (taken_counts_.empty()) return {{}, {0}};
    together(ranks, [&] {
      values =
          tabulated<T>("GALE::given_values", given_.count(), [&](Offset i) { return value_of(given_.entries(i)); });
    });
    return fetch(ranks, values);
  }

  /// Fetches what the others have, from the values of given_places().
  template <class T>
  EntriesByRank<T> fetch(const Ranks& ranks, const Array<T, HostMemory>& values) const {
    EntriesByRank<T> taken;
    if (taken_counts_.empty()) return {{}, {0}};
    together(ranks, [&] { taken = room_to_receive<T>("GALE::taken_values", taken_counts_); });
    exchange(ranks, EntriesByRank<T>{values, given_.begin}, taken);
    return taken;
  }

  /// The places whose values this rank gives to others, in the order in which it does.
  const Array<Id, HostMemory>& given_places() const { return given_.entries; }

  /// Fills to[slot], in the memory of `space`, for each of the slots: with what was fetched, and this rank's own values
  /// from[place], on the host.
  template <class Space, class T>
  void fill(const Space& space, const T* from, const EntriesByRank<T>& fetched, T* to) const {
    fill_run(space, from, to);
    fill_others(space, from, fetched, to);
  }

  /// Fills the slots of run(), of this rank's own values on the host. Not collective.
  template <class Space, class T>
  void fill_run(const Space&, const T* from, T* to) const {
    if constexpr (is_device<Space>) {
      copy_to_device(to + run_.slot, from + run_.place, static_cast<std::size_t>(run_.count) * sizeof(T));
    } else {
      parallel_for("GALE::kept_run", HostExecutionSpace(), run_.count,
                   [&](Offset i) { to[run_.slot + i] = from[run_.place + i]; });
    }
  }

  /// Fills all slots but those of run(), as fill() does.
  template <class Space, class T>
  void fill_others(const Space& space, const T* from, const EntriesByRank<T>& fetched, T* to) const {
    if constexpr (is_device<Space>) {
      const auto kept =
          tabulated<T>("GALE::kept_values", kept_places_.extent(0), [&](Offset i) { return from[kept_places_(i)]; });
      scatter(space, kept_slots_, kept, to);
    } else {
      parallel_for("GALE::kept_values", space, kept_slots_.extent(0),
                   [&](Offset i) { to[kept_slots_(i)] = from[kept_places_(i)]; });
    }
    fill_slots(space, fetched.entries, to);
  }

  /// Fills to[slot], in the memory of `space`, for each of slots() with what was fetched.
  template <class Space, class T>
  void fill_slots(const Space& space, const Array<T, HostMemory>& fetched, T* to) const {
    scatter(space, slots_, fetched, to);
  }

  /// The slots of what is fetched, in that order.
  const Array<Id, HostMemory>& slots() const { return slots_; }

  /// Fills to[slot] for each of the slots with from[place], all on the host. Collective.
  template <class T>
  void operator()(const Ranks& ranks, const T* from, T* to) const {
    const EntriesByRank<T> fetched = fetch<T>(ranks, [&](Id place) { return from[place]; });
    fill(HostExecutionSpace(), from, fetched, to);
  }

 private:
  template <class Space, class T>
  static void scatter(const Space& space, const Array<Id, HostMemory>& slots, const Array<T, HostMemory>& values,
                      T* to) {
    using Memory = MemoryOf<Space>;
    if (slots.extent(0) == 0) return;
    const Momentary<const Id, Memory> slots_here("GALE::slots", slots);
    const Momentary<const T, Memory> values_here("GALE::values_of_slots", values);
    parallel_for("GALE::write_to_slots", space, slots.extent(0),
                 WriteToSlots<T, Memory>{to, slots_here.array(), values_here.array()});
    space.fence();
  }

  Run run_;
  Array<Id, HostMemory> kept_slots_, kept_places_;  ///< of other values that this rank has itself
  EntriesByRank<Id> given_;                         ///< places, by the rank that takes them
  std::vector<std::int64_t> taken_counts_;          ///< by rank; empty where nothing is exchanged
  Array<Id, HostMemory> slots_;                     ///< in the order in which values come
};

template <class Source, class Key, class Place>
ExchangePlan::ExchangePlan(const Ranks& ranks, const Run& run, const Array<const Id, HostMemory>& slots,
                           const Source& source, const Key& key, const Place& place)
    : run_(run) {
  const auto asked = send_lists(ranks, "GALE::wanted_keys", [&] {
    const int here = ranks.rank();
    const EntriesByRank<Id> groups =
        group_by_rank(2, slots.extent(0), [&](Id i, const auto& visit) { visit(source(i) != here); });
    const Offset kept = groups.count(0);
    kept_slots_ = tabulated<Id>("GALE::kept_slots", kept, [&](Offset k) { return slots(groups.entries(k)); });
    kept_places_ =
        tabulated<Id>("GALE::kept_places", kept, [&](Offset k) { return place(GlobalId(key(groups.entries(k)))); });
    const auto other = [&](Offset i) { return groups.entries(kept + i); };
    auto keys = entries_by_rank<GlobalId>(
        ranks.size(), "GALE::wanted_keys", groups.count(1), [&](Id i) { return source(other(i)); },
        [&](Id i) { return GlobalId(key(other(i))); }, &slots_);
    parallel_for("GALE::wanted_slots", HostExecutionSpace(), slots_.extent(0),
                 [&](Offset i) { slots_(i) = slots(other(slots_(i))); });
    taken_counts_ = counts_of(keys);
    return std::make_tuple(std::move(keys));
  });
  together(ranks, [&] {
    const auto keys = std::get<0>(asked.unpack("GALE::given_keys"));
    given_ = room_by_rank<Id>("GALE::given_places", counts_of(keys));
    parallel_for("GALE::given_places", HostExecutionSpace(), keys.count(),
                 [&](Offset i) { given_.entries(i) = place(keys.entries(i)); });
  });
}

/// Brings what owners know of vertices of `mesh`, from the place that is `shift` before their input ids, to the
/// vertices of `some`, another mesh that calls them by the same global ids: an excerpt of each rank's own. Collective.
inline ExchangePlan plan_to(const Mesh& some, const Mesh& mesh, Id shift = 0) {
  const Ranks& ranks = mesh.exchange().ranks();
  Array<GlobalId, HostMemory> ids;
  Array<Id, HostMemory> slots;
  together(ranks, [&] {
    slots = iota("GALE::excerpt_slots", HostExecutionSpace(), some.vertices());
    ids = allocate<Array<GlobalId, HostMemory>>("GALE::excerpt_ids", some.vertices());
    for (Id v = 0; v < some.vertices(); ++v) ids(v) = some.vertex_id(v);
  });
  const auto owners = mesh.exchange().owners_of(ids);
  together(ranks, [&] {
    for (std::size_t v = 0; v < ids.extent(0); ++v) {
      if (owners(v) < 0) throw Error("no rank has a vertex " + std::to_string(ids(v)));
    }
  });
  return ExchangePlan(
      ranks, {}, slots, [&](Id i) { return owners(i); }, [&](Id i) { return ids(i); },
      [&](GlobalId id) { return mesh.vertex_of(id) - shift; });
}

/// What value(v) is of vertices of `mesh`, by input id, at those of `some`, by the ranks that own them. Collective.
template <class Value>
std::vector<double> values_at(const Mesh& some, const Mesh& mesh, const Value& value) {
  std::vector<double> here, there;
  together(mesh.exchange().ranks(), [&] {
    here.reserve(mesh.vertices());
    for (Id v = 0; v < mesh.vertices(); ++v) here.push_back(value(v));
    there.resize(some.vertices());
  });
  plan_to(some, mesh)(mesh.exchange().ranks(), here.data(), there.data());
  return there;
}

}  // namespace gale::detail
