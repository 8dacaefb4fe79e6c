#pragma once

#include <cstdint>
#include <vector>

#include <gale/base/bits.hpp>

namespace gale::detail {

/// A priority queue of numbers from 0 on: the least comes first. Each is in it once or not at all. A bit a number, and above each 64 words a word that says which
/// of them have any: a step for each of these levels to push and to pop. One serves one thread, and keeps its memory.
class KeyQueue {
 public:
  /// Of numbers below `bound`. It must be empty.
  void begin(std::size_t bound) {
    levels_ = 0;
    do {
      bound = (bound + 63) / 64;
      if (levels_ == static_cast<int>(words_.size())) words_.emplace_back();
      if (words_[levels_].size() < bound) words_[levels_].resize(bound, 0);
      ++levels_;
    } while (bound > 1);
  }

  bool empty() const { return words_[levels_ - 1][0] == 0; }

  void push(int number) {
    for (int level = 0; level < levels_; ++level) {
      words_[level][number >> 6] |= std::uint64_t(1) << (number & 63);
      number >>= 6;
    }
  }

  /// Takes the least one; there is one.
  int pop() {
    int least = 0;
    for (int level = levels_ - 1; level >= 0; --level) least = 64 * least + lowest_bit(words_[level][least]);
    int number = least;
    for (int level = 0; level < levels_; ++level) {
      std::uint64_t& word = words_[level][number >> 6];
      word &= ~(std::uint64_t(1) << (number & 63));
      if (word != 0) break;
      number >>= 6;
    }
    return least;
  }

 private:
  int levels_ = 0;
  std::vector<std::vector<std::uint64_t>> words_;  ///< by level; all 0 when it is empty
};

}  // namespace gale::detail
