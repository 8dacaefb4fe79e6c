#pragma once

#include <cstdint>
#include <vector>

#include <gale/base/bits.hpp>
#include <gale/base/types.hpp>

namespace gale::detail {

/// A set of places, a bit each. Once all members are there it numbers them in their order.
class NumberedSet {
 public:
  /// Makes an empty set of the places 0 to places - 1.
  explicit NumberedSet(Id places) : words_((static_cast<std::size_t>(places) >> 6) + 1, 0) {}

  /// Adds a place; false where it was a member before.
  bool insert(Id place) {
    std::uint64_t& word = words_[static_cast<std::size_t>(place) >> 6];
    const std::uint64_t bit = std::uint64_t(1) << (place & 63);
    if ((word & bit) != 0) return false;
    word |= bit;
    return true;
  }

  bool has(Id place) const { return (words_[static_cast<std::size_t>(place) >> 6] >> (place & 63) & 1) != 0; }

  /// Numbers the members. Once; none is added afterwards.
  void number() {
    before_.reserve(words_.size());
    for (const std::uint64_t word : words_) {
      before_.push_back(count_);
      count_ += count_bits(word);
    }
  }

  /// How many members were numbered.
  Id count() const { return count_; }

  /// The number of a member.
  Id operator[](Id place) const {
    const auto word = static_cast<std::size_t>(place) >> 6;
    return before_[word] + count_bits(words_[word] & ((std::uint64_t(1) << (place & 63)) - 1));
  }

 private:
  std::vector<std::uint64_t> words_;
  std::vector<Id> before_;  ///< members before each word
  Id count_ = 0;
};

}  // namespace gale::detail
