#pragma once

#include <cstdint>

#include <gale/base/bits.hpp>
#include <gale/base/types.hpp>

namespace gale::detail {

/// 64 places of a set, a bit each, and how many members come before them.
struct CountedWord {
  std::uint64_t bits = 0;
  Id before = 0;

  bool has(int place) const { return (bits >> place & 1) != 0; }

  /// How many members come before a place of these.
  Id rank(int place) const { return before + count_bits(bits & ((std::uint64_t(1) << place) - 1)); }

  void insert(int place) { bits |= std::uint64_t(1) << place; }
};

}  // namespace gale::detail
