#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include <gale/base/parallel.hpp>
#include <gale/distributed/communicator.hpp>

namespace gale::detail {

/// Global ids without gaps: begin to end - 1.
struct IdInterval {
  GlobalId begin = 0, end = 0;

  bool contains(GlobalId id) const { return id >= begin && id < end; }
  bool is_empty() const { return begin >= end; }

  /// What it has in common with another.
  IdInterval common(const IdInterval& other) const { return {std::max(begin, other.begin), std::min(end, other.end)}; }
};

/// Says which interval ids that ascend are, none of them twice; an empty one if they have gaps.
inline IdInterval interval_of(const Array<const GlobalId, HostMemory>& ascending) {
  const Offset count = ascending.extent(0);
  if (count == 0 || ascending(count - 1) - ascending(0) + 1 != count) return {};
  return {ascending(0), ascending(0) + count};
}

/// The interval whose ids these are, one after the other; nothing if they are others. Ids may be any numbers: where
/// both ends are ids, all are.
inline std::optional<IdInterval> counted_interval(const Array<const GlobalId, HostMemory>& ids) {
  const Offset count = ids.extent(0);
  if (count == 0) return IdInterval();
  const auto first = static_cast<std::uint64_t>(ids(0));
  const Offset others = reduce_sum("GALE::count_gaps", HostExecutionSpace(), count, [&](Offset i) {
    return Offset(static_cast<std::uint64_t>(ids(i)) != first + static_cast<std::uint64_t>(i));
  });
  if (others > 0) return std::nullopt;
  return IdInterval{ids(0), static_cast<GlobalId>(first + static_cast<std::uint64_t>(count))};
}

/// The vertices that a rank owns: an interval where their ids have no gaps, else the ids, ascending.
struct OwnedIds {
  IdInterval interval;
  Array<GlobalId, HostMemory> ids;  ///< empty where there is an interval

  OwnedIds() = default;
  explicit OwnedIds(const IdInterval& some) : interval(some) {}
  explicit OwnedIds(const Array<GlobalId, HostMemory>& ascending) : interval(interval_of(ascending)) {
    if (interval.is_empty()) ids = ascending;
  }

  Offset count() const { return interval.is_empty() ? Offset(ids.extent(0)) : interval.end - interval.begin; }
};

/// What each rank hands over, where those are intervals of ids in their order, as where a grid is cut into slabs. Then
/// each rank knows by itself who hands over what.
class GivenIntervals {
 public:
  explicit GivenIntervals(std::vector<IdInterval> by_rank) : by_rank_(std::move(by_rank)) {}

  /// Nothing if what any rank hands over is no interval. Collective.
  static std::optional<GivenIntervals> of(const Communicator& ranks, const std::optional<IdInterval>& ids) {
    if (ranks.least(std::int64_t(ids.has_value())) == 0) return std::nullopt;
    std::vector<IdInterval> by_rank;
    for (const auto& [begin, end] : all_numbers(ranks, std::array<std::int64_t, 2>{ids->begin, ids->end}))
      by_rank.push_back({begin, end});
    return GivenIntervals(std::move(by_rank));
  }

  /// The lowest rank that hands a vertex over; -1 if none does.
  int giver(GlobalId id) const {
    for (std::size_t rank = 0; rank < by_rank_.size(); ++rank) {
      if (by_rank_[rank].contains(id)) return static_cast<int>(rank);
    }
    return -1;
  }

  const IdInterval& of(int rank) const { return by_rank_[rank]; }

  int ranks() const { return static_cast<int>(by_rank_.size()); }

  /// Calls visit(interval) for each interval of ids that a rank is the lowest to hand over, ascending.
  template <class Visit>
  void visit_first_givers_of(int rank, const Visit& visit) const {
    for (GlobalId at = by_rank_[rank].begin; at < by_rank_[rank].end;) {
      GlobalId end = by_rank_[rank].end, covered = at;
      for (int lower = 0; lower < rank; ++lower) {
        const IdInterval& other = by_rank_[lower];
        if (other.contains(at)) covered = std::max(covered, other.end);
        if (other.begin > at && !other.is_empty()) end = std::min(end, other.begin);
      }
      if (covered == at) visit(IdInterval{at, end});
      at = covered == at ? end : covered;
    }
  }

 private:
  std::vector<IdInterval> by_rank_;
};

/// An interval of ids, to be compared with ids as an input has them, of `Index`: one comparison each, without a branch,
/// so that compilers do several at once.
template <class Index>
class IndexInterval {
  using Unsigned = std::make_unsigned_t<Index>;

 public:
  explicit IndexInterval(const IdInterval& ids) {
    constexpr GlobalId last = std::numeric_limits<Index>::max();
    if (ids.is_empty() || ids.begin > last) return;
    begin_ = static_cast<Unsigned>(ids.begin);
    size_ = static_cast<Unsigned>(std::min(ids.end - 1, last)) - begin_ + 1;
  }

  bool contains(Index id) const { return static_cast<Unsigned>(id) - begin_ < size_; }

  /// Whether it contains all of them.
  bool contains(const Index* ids, Offset count) const {
    if (size_ == 0) return count == 0;
    Unsigned farthest = 0;
    for (Offset i = 0; i < count; ++i) farthest = std::max(farthest, static_cast<Unsigned>(ids[i]) - begin_);
    return farthest < size_;
  }

  /// Writes the place in the interval of each that it contains, of others anything. Returns whether it contains all.
  bool write_places(const Index* ids, Offset count, Id* to) const {
    Unsigned farthest = 0;
    for (Offset i = 0; i < count; ++i) {
      const Unsigned place = static_cast<Unsigned>(ids[i]) - begin_;
      farthest = std::max(farthest, place);
      to[i] = static_cast<Id>(place);
    }
    return count == 0 || farthest < size_;
  }

 private:
  Unsigned begin_ = 0, size_ = 0;
};

}  // namespace gale::detail
