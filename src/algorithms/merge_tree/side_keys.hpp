#pragma once

#include <cstdint>

#include <Kokkos_Core.hpp>

#include <gale/base/types.hpp>

namespace gale::detail {

/// The two ways to go through an order: join trees from the lowest vertex, split trees from the highest.
enum Side { below = 0, above = 1 };

KOKKOS_FORCEINLINE_FUNCTION constexpr Side opposite(Side side) { return side == below ? above : below; }

/// The keys of an order as one side sees them: what it comes to first has the lowest.
struct SideKeys {
  const std::uint64_t* keys = nullptr;
  std::uint64_t flip = 0;

  SideKeys() = default;
  SideKeys(const std::uint64_t* all, Side side) : keys(all), flip(side == below ? 0 : ~std::uint64_t(0)) {}

  KOKKOS_FORCEINLINE_FUNCTION std::uint64_t operator[](Id vertex) const { return keys[vertex] ^ flip; }

  /// Does that side come to `a` before `b`?
  KOKKOS_FORCEINLINE_FUNCTION bool operator()(Id a, Id b) const { return (*this)[a] < (*this)[b]; }
};

}  // namespace gale::detail
