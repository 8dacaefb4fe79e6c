#pragma once

#include <cstdint>

#include <gale/base/bits.hpp>

namespace gale::detail {

/// A set of numbers below 64 * Words. Its default constructor leaves it uninitialized, so that arrays cost nothing.
template <int Words>
class CellSet {
 public:
  static constexpr int capacity = 64 * Words;

  KOKKOS_DEFAULTED_FUNCTION CellSet() = default;

  KOKKOS_FORCEINLINE_FUNCTION static CellSet none() {
    CellSet set;
    for (int w = 0; w < Words; ++w) set.words_[w] = 0;
    return set;
  }

  KOKKOS_FORCEINLINE_FUNCTION static CellSet of(int cell) {
    CellSet set = none();
    set.add(cell);
    return set;
  }

  KOKKOS_FORCEINLINE_FUNCTION void add(int cell) { words_[cell >> 6 & (Words - 1)] |= std::uint64_t(1) << (cell & 63); }
  KOKKOS_FORCEINLINE_FUNCTION void remove_lowest() {
    for (int w = 0; w < Words; ++w) {
      if (words_[w] == 0) continue;
      words_[w] &= words_[w] - 1;
      return;
    }
  }
  KOKKOS_FORCEINLINE_FUNCTION bool has(int cell) const { return words_[cell >> 6 & (Words - 1)] >> (cell & 63) & 1; }

  KOKKOS_FORCEINLINE_FUNCTION bool empty() const {
    std::uint64_t all = 0;
    for (int w = 0; w < Words; ++w) all |= words_[w];
    return all == 0;
  }

  /// Has it exactly one member?
  KOKKOS_FORCEINLINE_FUNCTION bool is_single() const {
    CellSet rest = *this;
    rest.remove_lowest();
    return rest.empty() && !empty();
  }

  /// The lowest member; there is one.
  KOKKOS_FORCEINLINE_FUNCTION int lowest() const {
    for (int w = 0; w < Words - 1; ++w) {
      if (words_[w] != 0) return 64 * w + lowest_bit(words_[w]);
    }
    return 64 * (Words - 1) + lowest_bit(words_[Words - 1]);
  }

  KOKKOS_FORCEINLINE_FUNCTION CellSet& operator|=(const CellSet& other) {
    for (int w = 0; w < Words; ++w) words_[w] |= other.words_[w];
    return *this;
  }
  KOKKOS_FORCEINLINE_FUNCTION CellSet& operator-=(const CellSet& other) {
    for (int w = 0; w < Words; ++w) words_[w] &= ~other.words_[w];
    return *this;
  }
  friend KOKKOS_FORCEINLINE_FUNCTION CellSet operator|(CellSet a, const CellSet& b) { return a |= b; }
  friend KOKKOS_FORCEINLINE_FUNCTION CellSet operator-(CellSet a, const CellSet& b) { return a -= b; }

 private:
  std::uint64_t words_[Words];
};

}  // namespace gale::detail
