#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <gale/io/bytes/values.hpp>

// Codes as deflate has them, and their bits.

namespace gale::io::detail {

/// A prefix code of the symbols that are counted, by Huffman.
template <unsigned Symbols>
struct PrefixCode {
  std::array<std::uint32_t, Symbols> count = {};
  std::array<std::uint8_t, Symbols> bits = {};
  std::array<std::uint16_t, Symbols> code = {};  ///< its first bit last, as it is written

  /// Finds the codes. Two symbols have one at least: not all readers take less.
  void find() {
    auto without = std::count(count.begin(), count.end(), 0u);
    for (unsigned s = 0; without > std::ptrdiff_t(Symbols) - 2; ++s) {
      if (count[s] == 0) --without;
      count[s] = std::max(count[s], 1u);
    }
    for (auto weights = count; !find_bits(weights);) {
      for (auto& weight : weights) weight = (weight + 1) / 2;
    }
    std::array<unsigned, most_bits + 1> next = {}, with_bits = {};
    for (const auto n : bits) ++with_bits[n];
    with_bits[0] = 0;
    for (unsigned n = 1; n <= most_bits; ++n) next[n] = (next[n - 1] + with_bits[n - 1]) << 1;
    for (unsigned s = 0; s < Symbols; ++s) {
      const unsigned n = bits[s], forward = n == 0 ? 0 : next[n]++;
      unsigned backward = 0;
      for (unsigned b = 0; b < n; ++b) backward |= (forward >> b & 1) << (n - 1 - b);
      code[s] = static_cast<std::uint16_t>(backward);
    }
  }

  /// How many bits all that is counted takes.
  std::size_t all_bits() const {
    std::size_t all = 0;
    for (unsigned s = 0; s < Symbols; ++s) all += std::size_t(count[s]) * bits[s];
    return all;
  }

 private:
  static constexpr unsigned most_bits = 15;

  /// Finds how many bits each symbol has; false if one needs too many.
  bool find_bits(const std::array<std::uint32_t, Symbols>& weights) {
    std::array<std::uint64_t, Symbols> leaves;
    unsigned count_of_leaves = 0;
    for (unsigned s = 0; s < Symbols; ++s) {
      if (weights[s] != 0) leaves[count_of_leaves++] = std::uint64_t(weights[s]) << 16 | s;
    }
    std::sort(leaves.begin(), leaves.begin() + count_of_leaves);
    std::array<std::uint64_t, 2 * Symbols> weight;
    std::array<unsigned, 2 * Symbols> parent, depth;
    for (unsigned i = 0; i < count_of_leaves; ++i) weight[i] = leaves[i] >> 16;
    unsigned leaf = 0, inner = count_of_leaves, end = count_of_leaves;
    const auto lightest = [&] {
      return leaf < count_of_leaves && (inner == end || weight[leaf] <= weight[inner]) ? leaf++ : inner++;
    };
    for (; end < 2 * count_of_leaves - 1; ++end) {
      const unsigned one = lightest(), other = lightest();
      weight[end] = weight[one] + weight[other];
      parent[one] = parent[other] = end;
    }
    bits = {};
    depth[end - 1] = 0;
    for (unsigned i = end - 1; i-- > 0;) {
      depth[i] = depth[parent[i]] + 1;
      if (i >= count_of_leaves) continue;
      if (depth[i] > most_bits) return false;
      bits[leaves[i] & 0xffff] = static_cast<std::uint8_t>(depth[i]);
    }
    return true;
  }
};

/// Puts bits one after the other, the lowest first. Up to 56 may wait for `flush`, which needs eight bytes of room.
class BitWriter {
 public:
  explicit BitWriter(char* to) : to_(to) {}

  void put(std::uint64_t value, unsigned bits) {
    waiting_ |= value << count_;
    count_ += bits;
  }

  template <unsigned Symbols>
  void put(const PrefixCode<Symbols>& code, unsigned symbol) {
    put(code.code[symbol], code.bits[symbol]);
  }

  void flush() {
    const std::uint64_t bytes = byte_order_of_machine() == ByteOrder::little ? waiting_ : reversed(waiting_);
    std::memcpy(to_, &bytes, sizeof bytes);
    to_ += count_ / 8;
    waiting_ >>= count_ / 8 * 8;
    count_ %= 8;
  }

  /// Flushes if so many bits, 49 at most, have no room.
  void make_room(unsigned bits) {
    if (count_ + bits > 56) flush();
  }

  /// Fills up the last byte, and says where the next one goes.
  char* end() {
    count_ = (count_ + 7) / 8 * 8;
    flush();
    return to_;
  }

 private:
  char* to_;
  std::uint64_t waiting_ = 0;
  unsigned count_ = 0;
};

}  // namespace gale::io::detail
