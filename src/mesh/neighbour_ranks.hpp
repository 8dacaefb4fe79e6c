#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include <gale/base/types.hpp>

namespace gale::detail {

/// The order of some neighbours, by input ids.
class NeighbourRanks {
 public:
  void begin(std::size_t count) {
    count_ = count;
    if (count > few) many_.resize(count);
  }
  Id* ids() { return count_ > few ? many_.data() : few_; }

  /// When all ids are written.
  void sort() {
    if (count_ > few) {
      std::sort(many_.begin(), many_.end());
    } else {
      std::fill(few_ + count_, few_ + few, std::numeric_limits<Id>::max());
    }
  }

  /// How many are before one; few are compared with all of them, in no order.
  Id rank_of(Id id) const {
    if (count_ > few) return static_cast<Id>(std::lower_bound(many_.begin(), many_.end(), id) - many_.begin());
    Id rank = 0;
    for (std::size_t i = 0; i < half; ++i) rank += few_[i] < id;
    if (count_ > half) {
      for (std::size_t i = half; i < few; ++i) rank += few_[i] < id;
    }
    return rank;
  }

 private:
  static constexpr std::size_t few = 16, half = few / 2;
  std::size_t count_ = 0;
  Id few_[few];
  std::vector<Id> many_;
};

}  // namespace gale::detail
