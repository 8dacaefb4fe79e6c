#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <Kokkos_Core.hpp>

namespace gale::detail {

/// How a value's bits are read.
enum class NumberKind { whole, with_sign, floating };

template <class Value>
constexpr NumberKind kind_of = std::is_floating_point_v<Value> ? NumberKind::floating
                               : std::is_signed_v<Value>       ? NumberKind::with_sign
                                                               : NumberKind::whole;

template <std::size_t bytes>
using RawOf = std::conditional_t<
    bytes == 8, std::uint64_t,
    std::conditional_t<bytes == 4, std::uint32_t, std::conditional_t<bytes == 2, std::uint16_t, std::uint8_t>>>;

template <class Raw>
using BitsOf = std::conditional_t<sizeof(Raw) == 8, std::uint64_t, std::uint32_t>;

/// An unsigned number that compares as the value does whose bits these are.
template <class Raw>
KOKKOS_FUNCTION BitsOf<Raw> ordered_bits(Raw raw, NumberKind kind) {
  using Bits = BitsOf<Raw>;
  constexpr Bits sign = Bits(1) << (8 * sizeof(Bits) - 1);
  if (kind == NumberKind::whole) return raw;
  if (kind == NumberKind::with_sign) return static_cast<Bits>(static_cast<std::make_signed_t<Raw>>(raw)) ^ sign;
  const Bits bits = raw == sign ? 0 : raw;  // -0 is 0
  return bits & sign ? ~bits : bits | sign;
}

/// Whether it is a floating number, and none.
template <class Raw>
KOKKOS_FUNCTION bool is_nan(Raw raw, NumberKind kind) {
  if constexpr (sizeof(Raw) < 4) {
    return false;
  } else {
    constexpr Raw infinity = sizeof(Raw) == 4 ? Raw(0xff) << 23 : static_cast<Raw>(std::uint64_t(0x7ff) << 52);
    return kind == NumberKind::floating && (raw & ~(Raw(1) << (8 * sizeof(Raw) - 1))) > infinity;
  }
}

}  // namespace gale::detail
