#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <gale/relations/rows.hpp>

namespace gale::detail {

/// For each of at most 16 keys how many are less, in four bits each, which stay in a register.
KOKKOS_FORCEINLINE_FUNCTION std::uint64_t ranks_of_few(const std::uint64_t* keys, int count) {
  std::uint64_t ranks = 0;
  for (int i = 1; i < count; ++i) {
    std::uint64_t below = 0;
    for (int j = 0; j < i; ++j) {
      const bool is_below = keys[j] < keys[i];
      below += is_below;
      ranks += std::uint64_t(!is_below) << 4 * j;
    }
    ranks += below << 4 * i;
  }
  return ranks;
}

/// Which neighbours of a vertex are lower than it, and their ranks among each other: 0 is the lowest.
class LowerNeighbours {
 public:
  static constexpr Id max_neighbours = 128;
  static constexpr int max_lower = 64;
  static constexpr std::uint8_t none = max_lower;  ///< the rank of an upper neighbour

  /// False if there are too many neighbours, or too many lower ones.
  KOKKOS_INLINE_FUNCTION bool find(const std::uint64_t* keys, Id vertex, const Row& neighbours) {
    count_ = 0;
    if (neighbours.size() > max_neighbours) return false;
    const std::uint64_t key = keys[vertex];
    std::uint64_t lower[max_lower + 1];
    for (Id i = 0; i < neighbours.size(); ++i) {
      const std::uint64_t other = keys[neighbours[i]];
      ranks_[i] = none;
      lower[count_] = other;
      place_[count_] = static_cast<std::uint8_t>(i);
      count_ += other < key;
      if (count_ > max_lower) return false;
    }
    if (count_ <= 16) {
      const std::uint64_t ranks = ranks_of_few(lower, count_);
      for (int i = 0; i < count_; ++i) rank_[i] = static_cast<std::uint8_t>(ranks >> 4 * i & 15);
    } else {
      rank_many(lower);
    }
    for (int i = 0; i < count_; ++i) {
      by_rank_[rank_[i]] = static_cast<std::uint8_t>(i);
      ranks_[place_[i]] = rank_[i];
    }
    return true;
  }

  /// How many are lower.
  KOKKOS_FORCEINLINE_FUNCTION int count() const { return count_; }

  /// For each neighbour in VV order its rank, or `none`.
  KOKKOS_FORCEINLINE_FUNCTION const std::uint8_t* ranks() const { return ranks_; }

  /// Place of the i-th lower neighbour in VV order.
  KOKKOS_FORCEINLINE_FUNCTION Id place(int i) const { return place_[i]; }

  /// Which of the lower neighbours has a rank.
  KOKKOS_FORCEINLINE_FUNCTION int with_rank(int rank) const { return by_rank_[rank]; }

 private:
  KOKKOS_FORCEINLINE_FUNCTION void rank_many(const std::uint64_t* lower) {
    for (int i = 0; i < count_; ++i) rank_[i] = 0;
    for (int i = 1; i < count_; ++i) {
      int below = 0;
      for (int j = 0; j < i; ++j) {
        const int is_below = lower[j] < lower[i];
        below += is_below;
        rank_[j] = static_cast<std::uint8_t>(rank_[j] + 1 - is_below);
      }
      rank_[i] = static_cast<std::uint8_t>(below);
    }
  }

  int count_;
  std::uint8_t ranks_[max_neighbours];
  std::uint8_t place_[max_lower + 1];
  std::uint8_t rank_[max_lower + 1];
  std::uint8_t by_rank_[max_lower];
};

/// What LowerNeighbours does, for any number of neighbours, on the host. One serves one thread, and keeps its memory.
class ManyLowerNeighbours {
 public:
  void find(const std::uint64_t* keys, Id vertex, const Row& neighbours) {
    ranks_.assign(neighbours.size(), no_id);
    place_.clear();
    for (Id i = 0; i < neighbours.size(); ++i) {
      if (keys[neighbours[i]] < keys[vertex]) place_.push_back(i);
    }
    by_rank_.resize(place_.size());
    for (int i = 0; i < count(); ++i) by_rank_[i] = i;
    std::sort(by_rank_.begin(), by_rank_.end(),
              [&](int i, int j) { return keys[neighbours[place_[i]]] < keys[neighbours[place_[j]]]; });
    for (int rank = 0; rank < count(); ++rank) ranks_[place_[by_rank_[rank]]] = rank;
  }

  int count() const { return static_cast<int>(place_.size()); }
  const std::vector<Id>& ranks() const { return ranks_; }
  Id place(int i) const { return place_[i]; }
  int with_rank(Id rank) const { return by_rank_[rank]; }

 private:
  std::vector<Id> ranks_, place_;
  std::vector<int> by_rank_;
};

}  // namespace gale::detail
