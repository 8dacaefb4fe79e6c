#pragma once

#include <cstdint>
#include <vector>

#include <gale/base/bits.hpp>

namespace gale::detail {

/// A priority queue of numbers from 0 on, the least first. Each is in it once or not at all. It has a bit for each
/// number. Above them is a level with a bit for each word of 64 bits, set if that word isn't 0, and so on up to a
/// single word. To push and to pop takes a step for each level. One serves one thread, and keeps its memory.
class KeyQueue {
 public:
  /// Makes room for numbers below `bound`. The queue must be empty.
  void begin(std::size_t bound) {
    for (levels_ = 0; bound > 64; ++levels_) {
      bound = (bound + 63) / 64;
      if (levels_ == static_cast<int>(words_.size())) words_.emplace_back();
      if (words_[levels_].size() < bound) words_[levels_].resize(bound, 0);
    }
  }

  bool empty() const { return top_ == 0; }

  void push(int number) {
    for (int level = 0; level < levels_; ++level) {
      words_[level][number >> 6] |= bit(number);
      number >>= 6;
    }
    top_ |= bit(number);
  }

  /// Takes the least one; there is one.
  int pop() {
    int least = lowest_bit(top_);
    for (int level = levels_ - 1; level >= 0; --level) least = 64 * least + lowest_bit(words_[level][least]);
    remove(least);
    return least;
  }

 private:
  static std::uint64_t bit(int number) { return std::uint64_t(1) << (number & 63); }

  void remove(int number) {
    for (int level = 0; level < levels_; ++level) {
      std::uint64_t& word = words_[level][number >> 6];
      word &= ~bit(number);
      if (word != 0) return;
      number >>= 6;
    }
    top_ &= ~bit(number);
  }

  std::uint64_t top_ = 0;
  int levels_ = 0;                                 ///< below it
  std::vector<std::vector<std::uint64_t>> words_;  ///< by level; all 0 when it is empty
};

}  // namespace gale::detail
