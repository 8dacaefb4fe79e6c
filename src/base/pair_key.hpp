#pragma once

#include <cstdint>

#include <gale/base/kokkos.hpp>
#include <gale/base/types.hpp>

namespace gale {

/// Two ids in one number, which compares as the pair of them does. Ids are 0 or more.
KOKKOS_FORCEINLINE_FUNCTION constexpr std::uint64_t pair_key(Id first, Id second) {
  return std::uint64_t(static_cast<std::uint32_t>(first)) << 32 | static_cast<std::uint32_t>(second);
}

KOKKOS_FORCEINLINE_FUNCTION constexpr Id pair_first(std::uint64_t key) { return static_cast<Id>(key >> 32); }
KOKKOS_FORCEINLINE_FUNCTION constexpr Id pair_second(std::uint64_t key) { return static_cast<Id>(key & 0xffffffffu); }

/// Spreads keys evenly over hash tables of up to 2^40 places: Fibonacci hashing.
KOKKOS_FORCEINLINE_FUNCTION constexpr std::uint64_t spread(std::uint64_t key) {
  return (key * 0x9e3779b97f4a7c15u) >> 24;
}

}  // namespace gale
