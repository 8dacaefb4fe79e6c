#pragma once

#include <cstdint>

#include <gale/base/kokkos.hpp>
#include <gale/base/types.hpp>

// What C++20 has in <bit>, and keys made of bits.

namespace gale {

namespace detail {

inline constexpr std::uint64_t one_a_byte = 0x0101010101010101U;

/// How many bits are set in each byte and those below it, in that byte.
KOKKOS_FORCEINLINE_FUNCTION std::uint64_t bits_up_to_bytes(std::uint64_t bits) {
  bits -= bits >> 1 & 0x5555555555555555U;
  bits = (bits & 0x3333333333333333U) + (bits >> 2 & 0x3333333333333333U);
  bits = (bits + (bits >> 4)) & 0x0f0f0f0f0f0f0f0fU;
  return bits * one_a_byte;
}

/// How many bytes are n at most; none is above 127, nor n.
KOKKOS_FORCEINLINE_FUNCTION int bytes_up_to(std::uint64_t bytes, int n) {
  constexpr std::uint64_t high = one_a_byte << 7;
  const std::uint64_t at_most = ((std::uint64_t(n) * one_a_byte | high) - bytes) & high;
  return static_cast<int>((at_most >> 7) * one_a_byte >> 56);
}

/// For processors of which the compiler doesn't know that they count bits: its own way is a call, and looks up tables.
KOKKOS_FORCEINLINE_FUNCTION int add_up_bits(std::uint64_t bits) {
  return static_cast<int>(bits_up_to_bytes(bits) >> 56);
}

}  // namespace detail

KOKKOS_FORCEINLINE_FUNCTION int count_bits(std::uint32_t bits) {
#if defined(GALE_ON_DEVICE)
  return __popc(bits);
#elif defined(__x86_64__) && !defined(__POPCNT__)
  return detail::add_up_bits(bits);
#else
  return __builtin_popcount(bits);
#endif
}

KOKKOS_FORCEINLINE_FUNCTION int count_bits(std::uint64_t bits) {
#if defined(GALE_ON_DEVICE)
  return __popcll(bits);
#elif defined(__x86_64__) && !defined(__POPCNT__)
  return detail::add_up_bits(bits);
#else
  return __builtin_popcountll(bits);
#endif
}

/// Place of the lowest bit that is set; one is.
KOKKOS_FORCEINLINE_FUNCTION int lowest_bit(std::uint32_t bits) {
#if defined(GALE_ON_DEVICE)
  return __ffs(static_cast<int>(bits)) - 1;
#else
  return __builtin_ctz(bits);
#endif
}

KOKKOS_FORCEINLINE_FUNCTION int lowest_bit(std::uint64_t bits) {
#if defined(GALE_ON_DEVICE)
  return __ffsll(static_cast<long long>(bits)) - 1;
#else
  return __builtin_ctzll(bits);
#endif
}

/// Place of the n-th bit that is set, counted from 0 and the lowest; n is less than their number. Without branches,
/// which nobody could foretell.
KOKKOS_INLINE_FUNCTION int nth_bit(std::uint64_t bits, int n) {
  using namespace detail;
  const std::uint64_t up_to = bits_up_to_bytes(bits);
  const int byte = 8 * bytes_up_to(up_to, n);
  const int before = static_cast<int>(up_to << 8 >> byte & 0xff);
  const std::uint64_t bit_a_byte = (bits >> byte & 0xff) * one_a_byte & 0x8040201008040201U;
  const std::uint64_t is_set = (bit_a_byte + 127 * one_a_byte) >> 7 & one_a_byte;
  return byte + bytes_up_to(is_set * one_a_byte, n - before);
}

/// Place of the highest bit that is set; one is.
KOKKOS_FORCEINLINE_FUNCTION int highest_bit(std::uint64_t bits) {
#if defined(GALE_ON_DEVICE)
  return 63 - __clzll(static_cast<long long>(bits));
#else
  return 63 - __builtin_clzll(bits);
#endif
}

/// Calls visit(place) for the bits that are set in `words` words of 32, `stride` apart, ascending. One loop over words
/// and bits, so that lanes which go through different sets wait for the longest set only, not for the longest word each
/// time.
template <class Visit>
KOKKOS_FORCEINLINE_FUNCTION void for_each_bit(const std::uint32_t* column, int stride, int words, const Visit& visit) {
  std::uint32_t bits = 0;
  for (int word = -1; bits != 0 || word + 1 < words;) {
    if (bits == 0) bits = column[++word * stride];
    if (bits != 0) visit(32 * word + lowest_bit(bits));
    bits &= bits - 1;
  }
}

namespace detail {

/// Four small numbers in one word, so that memory is asked once for all of them.
class Bytes {
 public:
  KOKKOS_DEFAULTED_FUNCTION Bytes() = default;
  KOKKOS_FORCEINLINE_FUNCTION Bytes(int a, int b, int c, int d = 0)
      : word_(static_cast<std::uint32_t>(a) | static_cast<std::uint32_t>(b) << 8 | static_cast<std::uint32_t>(c) << 16 |
              static_cast<std::uint32_t>(d) << 24) {}

  KOKKOS_FORCEINLINE_FUNCTION int operator[](int i) const { return static_cast<int>(word_ >> (8 * i) & 255); }

 private:
  std::uint32_t word_;
};

/// 64 places of a set, a bit each, and how many members come before them.
struct CountedWord {
  std::uint64_t bits = 0;
  Id before = 0;

  KOKKOS_FUNCTION bool has(int place) const { return (bits >> place & 1) != 0; }

  /// How many members come before a place of these.
  KOKKOS_FUNCTION Id rank(int place) const { return before + count_bits(bits & ((std::uint64_t(1) << place) - 1)); }

  void insert(int place) { bits |= std::uint64_t(1) << place; }
};

}  // namespace detail

/// Two ids in one number, which compares as the pair of them does. Ids are 0 or more.
KOKKOS_FORCEINLINE_FUNCTION constexpr std::uint64_t pair_key(Id first, Id second) {
  return std::uint64_t(static_cast<std::uint32_t>(first)) << 32 | static_cast<std::uint32_t>(second);
}

KOKKOS_FORCEINLINE_FUNCTION constexpr Id pair_first(std::uint64_t key) { return static_cast<Id>(key >> 32); }
KOKKOS_FORCEINLINE_FUNCTION constexpr Id pair_second(std::uint64_t key) { return static_cast<Id>(key & 0xffffffffu); }

/// Spreads keys evenly over hash tables of up to 2^spread_bits places: Fibonacci hashing.
inline constexpr int spread_bits = 40;
KOKKOS_FORCEINLINE_FUNCTION constexpr std::uint64_t spread(std::uint64_t key) {
  return (key * 0x9e3779b97f4a7c15u) >> (64 - spread_bits);
}

}  // namespace gale
