#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <gale/base/memory.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

/// Ascending keys, and where those begin that have the same leading bits: what is looked up many times among them is
/// found near by. For code that runs on `Memory`.
template <class Memory>
class SortedKeys {
 public:
  explicit SortedKeys(const std::vector<std::uint64_t>& keys) {
    if (keys.empty()) return;
    lowest_ = keys.front();
    highest_ = keys.back();
    while ((highest_ - lowest_) >> shift_ >= (std::uint64_t(1) << bucket_bits)) ++shift_;
    const auto count = static_cast<std::int64_t>(keys.size()),
               buckets = static_cast<std::int64_t>(bucket(highest_)) + 1;
    const auto begin = allocate<Array<std::int64_t, HostMemory>>("GALE::sorted_keys_begin", buckets + 1);
    std::fill_n(begin.data(), buckets + 1, count);
    for (std::int64_t i = count; i-- > 0;) begin(bucket(keys[i])) = i;
    for (std::int64_t b = buckets; b-- > 0;) begin(b) = std::min(begin(b), begin(b + 1));
    keys_ = in_memory<Memory>(array_of("GALE::sorted_keys", keys));
    begin_ = in_memory<Memory>(begin);
  }

  KOKKOS_FUNCTION std::uint64_t operator[](std::int64_t place) const { return keys_(place); }

  struct Range {
    std::int64_t first, last;
  };

  /// Says where a key's neighbours are: all before `first` are less than it, all from `last` on greater.
  KOKKOS_FUNCTION Range around(std::uint64_t key) const {
    const auto count = static_cast<std::int64_t>(keys_.extent(0));
    if (count == 0 || key < lowest_) return {0, 0};
    if (key > highest_) return {count, count};
    return {begin_(bucket(key)), begin_(bucket(key) + 1)};
  }

 private:
  static constexpr int bucket_bits = 16;

  KOKKOS_FUNCTION std::uint64_t bucket(std::uint64_t key) const { return (key - lowest_) >> shift_; }

  Array<const std::uint64_t, Memory> keys_;
  Array<const std::int64_t, Memory> begin_;  ///< by bucket, and their end
  std::uint64_t lowest_ = 0, highest_ = 0;
  int shift_ = 0;
};

}  // namespace gale::detail
