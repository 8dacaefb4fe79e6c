#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>

#include <Kokkos_Core.hpp>

namespace gale::detail {

template <class Value>
using BitsOf = std::conditional_t<sizeof(Value) == 8, std::uint64_t, std::uint32_t>;

/// An unsigned number that compares as the value does.
template <class Value>
KOKKOS_FUNCTION BitsOf<Value> ordered_bits(Value value) {
  using Bits = BitsOf<Value>;
  constexpr Bits sign = Bits(1) << (8 * sizeof(Bits) - 1);
  if constexpr (std::is_floating_point_v<Value>) {
    value += Value(0);  // -0 becomes 0
    Bits bits;
    std::memcpy(&bits, &value, sizeof(bits));
    return bits & sign ? ~bits : bits | sign;
  } else if constexpr (std::is_signed_v<Value>) {
    return static_cast<Bits>(value) ^ sign;
  } else {
    return value;
  }
}

}  // namespace gale::detail
