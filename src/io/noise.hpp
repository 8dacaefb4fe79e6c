#pragma once

#include <cstdint>

namespace gale::io::detail {

/// A number that looks random, for any other: the noise of synthetic fields.
inline std::uint32_t noise(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352dU;
  x ^= x >> 15;
  x *= 0x846ca68bU;
  return x ^ (x >> 16);
}

}  // namespace gale::io::detail
