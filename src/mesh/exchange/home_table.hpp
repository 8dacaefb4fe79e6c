#pragma once

#include <algorithm>
#include <type_traits>
#include <vector>

#include <gale/mesh/exchange/global_index.hpp>
#include <gale/mesh/exchange/messages.hpp>

namespace gale::detail {

/// Intervals of global ids of equal lengths, one a rank: the rank is their home.
class Homes {
 public:
  Homes() = default;

  /// For the ids id_of(i) of the items 0..items-1 of each rank. Collective.
  template <class IdOf>
  Homes(const Ranks& ranks, Offset items, const IdOf& id_of) : ranks_(ranks.size()) {
    const GlobalId greatest = -ranks.least(
        reduce_min("GALE::greatest_id", HostExecutionSpace(), items, GlobalId(0), [&](Offset i) { return -id_of(i); }));
    ids_a_home_ = greatest / ranks.size() + 1;
  }

  /// The home of any id; ids beyond all have the last rank.
  int of(GlobalId id) const { return static_cast<int>(std::min<GlobalId>(id / ids_a_home_, ranks_ - 1)); }

 private:
  int ranks_ = 1;
  GlobalId ids_a_home_ = 1;
};

/// Entries by global id, spread over the ranks: each keeps those of its interval of ids. Made and asked by all ranks
/// together.
template <class Entry>
class HomeTable {
  struct Nobody {
    template <class Handed>
    void operator()(int, const Handed&, const Entry&) const {}
  };

 public:
  HomeTable() = default;

  /// Takes ids that ranks have, with handed_of(i) for the i-th of this rank; entry_from(rank, handed) is what its home
  /// keeps of one. Where several ranks have an id, or one several times, the lowest rank's first counts, and
  /// visit_other(rank, handed, entry), which may change the entry, is called for each other one, on one thread of the
  /// home's.
  template <class HandedOf, class EntryFrom, class VisitOther = Nobody>
  HomeTable(const Ranks& ranks, const Array<const GlobalId, HostMemory>& ids, const HandedOf& handed_of,
            const EntryFrom& entry_from, const VisitOther& visit_other = {})
      : homes_(ranks, ids.extent(0), ids) {
    struct Handed {
      GlobalId id;
      decltype(handed_of(Id())) what;
    };
    const auto sent = collect_by_rank<Handed>(
        ranks, "GALE::handed_entries", ids.extent(0), [&](Id i) { return homes_.of(ids(i)); },
        [&](Id i) {
          return Handed{ids(i), handed_of(i)};
        });
    const auto received = exchange(ranks, "GALE::known_entries", sent);
    together(ranks, [&] {
      const DistinctIds distinct = distinct_ids(
          tabulated<GlobalId>("GALE::known_ids", received.count(), [&](Offset i) { return received.entries(i).id; }));
      index_ = GlobalIndex(distinct.ids);
      entries_ = allocate<Array<Entry, HostMemory>>("GALE::home_entries", index_.count());
      parallel_for("GALE::home_entries", HostExecutionSpace(), index_.count(), [&](Offset i) {
        const Id at = distinct.places(i);
        entries_(i) = entry_from(received.rank_of(at), received.entries(at).what);
      });
      if (std::is_same_v<VisitOther, Nobody> || index_.count() == received.count()) return;
      const auto place_of = [&](Offset at) { return index_.find(received.entries(at).id); };
      const auto others = collected<Id>("GALE::other_entries", received.count(), [&](Offset at, const auto& add) {
        if (distinct.places(place_of(at)) != at) add(static_cast<Id>(at));
      });
      for (const Id at : others) visit_other(received.rank_of(at), received.entries(at).what, entries_(place_of(at)));
    });
  }

  /// The entries of any ids, `otherwise` for those that it lacks.
  Array<Entry, HostMemory> find(const Ranks& ranks, const Array<const GlobalId, HostMemory>& ids,
                                const Entry& otherwise = Entry()) const {
    return ask<Entry>(
        ranks, "GALE::found_entries", ids.extent(0), [&](Id i) { return homes_.of(ids(i)); },
        [&](Id i) { return ids(i); },
        [&](GlobalId id) {
          const Id place = index_.find(id);
          return place == no_id ? otherwise : entries_(place);
        });
  }

  /// What this rank keeps, by ascending id.
  Offset count() const { return index_.count(); }
  GlobalId id(Offset i) const { return index_[i]; }
  const Entry& entry(Offset i) const { return entries_(i); }

 private:
  Homes homes_;
  GlobalIndex index_;
  Array<Entry, HostMemory> entries_;
};

}  // namespace gale::detail
