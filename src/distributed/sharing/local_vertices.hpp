#pragma once

#include <algorithm>

#include <gale/distributed/mesh_part.hpp>
#include <gale/distributed/sharing/id_interval.hpp>
#include <gale/mesh/exchange/exchange_plan.hpp>
#include <gale/mesh/exchange/global_index.hpp>

namespace gale::detail {

/// The vertices that a rank holds, by ascending global ids: local input ids are places among them. Where those that it
/// owns have no gaps, as where a grid is cut into slabs, it takes room for the ghosts alone.
class LocalVertices {
 public:
  LocalVertices() = default;

  /// `ghosts` ascend.
  LocalVertices(const OwnedIds& owned, const GlobalIds& ghosts);

  Offset count() const { return owned_count_ + static_cast<Offset>(ghosts_.extent(0)); }
  Offset owned_count() const { return owned_count_; }
  Offset ghost_count() const { return ghosts_.extent(0); }

  /// The global ids of those that it owns; empty if they have gaps.
  const IdInterval& interval() const { return interval_; }

  const GlobalIds& ghosts() const { return ghosts_; }

  /// The local input ids of those that it owns; none where they are an interval, from owned(0) on.
  const Array<Id, HostMemory>& owned_ids() const { return owned_; }

  GlobalId id(Id v) const {
    if (interval_.is_empty()) return all_(v);
    const auto shared = static_cast<Offset>(v) - lower_ghosts_;
    if (shared < 0) return ghosts_(v);
    return shared < owned_count_ ? interval_.begin + shared : ghosts_(v - owned_count_);
  }

  /// no_id if it isn't there. By any thread.
  Id find(GlobalId id) const {
    if (interval_.contains(id)) return static_cast<Id>(lower_ghosts_ + (id - interval_.begin));
    const Id found = index_.find(id);
    return interval_.is_empty() || found == no_id ? found : ghost(found);
  }

  /// The local input id of the i-th one that it owns, and of the i-th ghost.
  Id owned(Offset i) const { return interval_.is_empty() ? owned_(i) : static_cast<Id>(lower_ghosts_ + i); }
  Id ghost(Offset i) const {
    if (interval_.is_empty()) return ghost_(i);
    return static_cast<Id>(i < lower_ghosts_ ? i : i + owned_count_);
  }

  /// Which ghost that is.
  Offset ghost_number(Id v) const {
    if (interval_.is_empty()) return std::lower_bound(ghost_.data(), ghost_.data() + ghost_count(), v) - ghost_.data();
    return v < lower_ghosts_ ? Offset(v) : v - owned_count_;
  }

  /// Which ghost that is; -1 if it is owned.
  Offset ghost_if_any(Id v) const {
    if (!interval_.is_empty()) return v >= lower_ghosts_ && v < lower_ghosts_ + owned_count_ ? -1 : ghost_number(v);
    const Offset number = ghost_number(v);
    return number < ghost_count() && ghost_(number) == v ? number : -1;
  }

  /// An array by local input ids: own(i) of the i-th one that it owns, and of_ghost(i) of the i-th ghost.
  template <class T, class Own, class OfGhost>
  Array<T, HostMemory> tabulated(const char* label, const Own& own, const OfGhost& of_ghost) const {
    const auto all = allocate<Array<T, HostMemory>>(label, count());
    parallel_for(label, HostExecutionSpace(), owned_count(), [&](Offset i) { all(owned(i)) = own(i); });
    parallel_for(label, HostExecutionSpace(), ghost_count(), [&](Offset i) { all(ghost(i)) = of_ghost(i); });
    return all;
  }

 private:
  void merge(const GlobalIds& owned);

  IdInterval interval_;
  Offset owned_count_ = 0, lower_ghosts_ = 0;  ///< ghosts below the interval
  GlobalIds ghosts_;
  GlobalIndex index_;                    ///< finds ghosts or, where there are gaps, all
  GlobalIds all_;                        ///< where there are gaps, as the next ones
  Array<Id, HostMemory> owned_, ghost_;  ///< local input ids
};

/// A point on its way to another rank.
struct SentPoint {
  double coordinates[3];
};

/// Where the vertices are that a rank holds: those that it owns, and its ghosts, each in their order.
struct OwnAndGhosts {
  HostPoints owned, ghosts;

  /// All of them, by local input ids.
  Points<double, HostMemory> by_id(const LocalVertices& vertices) const;
};

/// From the points that a rank hands over, and those that it has fetched by `plan` from others. Where `run` has what it
/// owns, only ghosts were fetched, and the others stay where they are.
OwnAndGhosts own_and_ghosts(const LocalVertices& vertices, const HostPoints& given, const ExchangePlan::Run& run,
                            const ExchangePlan& plan, const EntriesByRank<SentPoint>& fetched);

}  // namespace gale::detail
