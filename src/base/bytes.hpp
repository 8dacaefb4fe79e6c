#pragma once

#include <cstdint>

#include <gale/base/kokkos.hpp>

namespace gale::detail {

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

}  // namespace gale::detail
