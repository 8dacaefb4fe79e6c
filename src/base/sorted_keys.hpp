#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace gale::detail {

/// Ascending keys, and where those begin that have the same leading bits: what is looked up many times among them is
/// found near by.
class SortedKeys {
 public:
  explicit SortedKeys(std::vector<std::uint64_t> keys) : keys_(std::move(keys)) {
    if (keys_.empty()) return;
    const std::uint64_t range = keys_.back() - keys_.front();
    while (range >> shift_ >= (std::uint64_t(1) << bucket_bits)) ++shift_;
    begin_.assign((range >> shift_) + 2, static_cast<std::int64_t>(keys_.size()));
    for (std::size_t i = keys_.size(); i-- > 0;) begin_[bucket(keys_[i])] = static_cast<std::int64_t>(i);
    for (std::size_t b = begin_.size() - 1; b-- > 0;) begin_[b] = std::min(begin_[b], begin_[b + 1]);
  }

  std::uint64_t operator[](std::int64_t place) const { return keys_[place]; }

  struct Range {
    std::int64_t first, last;
  };

  /// Says where a key's neighbours are: all before `first` are less than it, all from `last` on greater.
  Range around(std::uint64_t key) const {
    const auto count = static_cast<std::int64_t>(keys_.size());
    if (count == 0 || key < keys_.front()) return {0, 0};
    if (key > keys_.back()) return {count, count};
    return {begin_[bucket(key)], begin_[bucket(key) + 1]};
  }

 private:
  static constexpr int bucket_bits = 16;

  std::uint64_t bucket(std::uint64_t key) const { return (key - keys_.front()) >> shift_; }

  std::vector<std::uint64_t> keys_;
  std::vector<std::int64_t> begin_;
  int shift_ = 0;
};

}  // namespace gale::detail
