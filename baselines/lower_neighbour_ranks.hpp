#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <gale/base/types.hpp>

namespace gale::detail {

/// The lower neighbours of a vertex, by their ranks among each other, 0 the lowest; and the rank of any neighbour. For
/// any number of neighbours. One serves one thread, and keeps its memory.
class LowerNeighbourRanks {
 public:
  /// `neighbours`: all neighbours of the vertex, ascending. They are kept by reference until the next call.
  void find(const std::uint64_t* keys, Id vertex, const std::vector<Id>& neighbours) {
    neighbours_ = &neighbours;
    if (lower_.size() < neighbours.size() + 1) {
      lower_.resize(neighbours.size() + 1);
      keys_.resize(neighbours.size() + 1);
      place_.resize(neighbours.size() + 1);
    }
    const std::uint64_t key = keys[vertex];
    count_ = 0;
    for (const Id other : neighbours) {
      lower_[count_] = other;
      keys_[count_] = keys[other];
      count_ += keys_[count_] < key;
    }
    sort();
    make_table();
  }

  /// How many are lower.
  Id count() const { return count_; }

  /// The i-th lower neighbour by id; the place among these of the one with a rank; and its id.
  Id lower(Id i) const { return lower_[i]; }
  Id place(Id rank) const { return place_[rank]; }
  Id id(Id rank) const { return lower_[place(rank)]; }

  /// Calls use(rank), where rank(neighbour) is the rank of a neighbour, below 0 that of an upper one.
  template <class Use>
  void with_look_up(const Use& use) const {
    if (is_hashed_) {
      use([table = &table_[0], multiplier = multiplier_](Id neighbour) {
        return Id(table[slot(neighbour, multiplier)]);
      });
    } else {
      use([this](Id neighbour) { return ranks_[place_of(neighbour)]; });
    }
  }

 private:
  static constexpr int slot_bits = 12;
  static constexpr std::size_t most_hashed = 64;

  static std::uint32_t slot(Id neighbour, std::uint32_t multiplier) {
    return static_cast<std::uint32_t>(neighbour) * multiplier >> (32 - slot_bits);
  }
  std::uint32_t slot(Id neighbour) const { return slot(neighbour, multiplier_); }

  /// The place of one among all neighbours.
  std::ptrdiff_t place_of(Id neighbour) const {
    return std::lower_bound(neighbours_->begin(), neighbours_->end(), neighbour) - neighbours_->begin();
  }

  /// Few are sorted by counting those below each, which needs no branch.
  void sort() {
    constexpr Id few = 16;
    if (count_ <= few) {
      for (Id i = 0; i < count_; ++i) {
        Id rank = 0;
        for (Id j = 0; j < count_; ++j) rank += keys_[j] < keys_[i];
        place_[rank] = i;
      }
    } else {
      for (Id i = 0; i < count_; ++i) place_[i] = i;
      std::sort(place_.begin(), place_.begin() + count_, [this](Id i, Id j) { return keys_[i] < keys_[j]; });
    }
  }

  /// Few neighbours get a hash table without collisions. As only neighbours are looked up in it, it needs no ids, and
  /// is never cleared.
  void make_table() {
    is_hashed_ = find_multiplier();
    if (is_hashed_) {
      for (const Id other : *neighbours_) table_[slot(other)] = -1;
      for (Id rank = 0; rank < count(); ++rank) table_[slot(id(rank))] = static_cast<std::int8_t>(rank);
    } else {
      ranks_.assign(neighbours_->size(), -1);
      for (Id rank = 0; rank < count(); ++rank) ranks_[place_of(id(rank))] = rank;
    }
  }

  bool find_multiplier() {
    if (neighbours_->size() > most_hashed) return false;
    multiplier_ = 2654435769u;
    for (int attempt = 0; attempt < 8; ++attempt, multiplier_ = multiplier_ * 747796405u | 1u) {
      std::int8_t number = 0;
      for (const Id other : *neighbours_) table_[slot(other)] = number++;
      bool is_free = true;
      number = 0;
      for (const Id other : *neighbours_) is_free &= table_[slot(other)] == number++;
      if (is_free) return true;
    }
    return false;
  }

  const std::vector<Id>* neighbours_ = nullptr;
  Id count_ = 0;
  std::vector<Id> lower_;            ///< by id, with room for one more; likewise
  std::vector<std::uint64_t> keys_;  ///< the keys of lower neighbours
  std::vector<Id> place_;            ///< rank -> place in lower_
  bool is_hashed_ = false;
  std::uint32_t multiplier_ = 0;
  std::int8_t table_[1 << slot_bits] = {};
  std::vector<Id> ranks_;
};

}  // namespace gale::detail
