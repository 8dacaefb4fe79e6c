#pragma once

#include <cstddef>
#include <vector>

#include <gale/base/bits.hpp>
#include <gale/base/types.hpp>

namespace gale::detail {

/// A set of places, a bit each. Once all members are there it numbers them in their order.
class NumberedSet {
 public:
  /// Makes an empty set of the places 0 to places - 1.
  explicit NumberedSet(Id places) : words_((static_cast<std::size_t>(places) >> 6) + 1) {}

  /// Adds a place; false where it was a member before.
  bool insert(Id place) {
    CountedWord& word = words_[static_cast<std::size_t>(place) >> 6];
    if (word.has(place & 63)) return false;
    word.insert(place & 63);
    return true;
  }

  bool has(Id place) const { return words_[static_cast<std::size_t>(place) >> 6].has(place & 63); }

  /// Numbers the members. Once; none is added afterwards.
  void number() {
    for (CountedWord& word : words_) {
      word.before = count_;
      count_ += count_bits(word.bits);
    }
  }

  /// How many members were numbered.
  Id count() const { return count_; }

  /// The number of a member.
  Id operator[](Id place) const { return words_[static_cast<std::size_t>(place) >> 6].rank(place & 63); }

 private:
  std::vector<CountedWord> words_;
  Id count_ = 0;
};

}  // namespace gale::detail
