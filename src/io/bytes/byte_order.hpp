#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace gale::io::detail {

enum class ByteOrder { little, big };

inline ByteOrder byte_order_of_machine() {
  const std::uint16_t one = 1;
  unsigned char first;
  std::memcpy(&first, &one, 1);
  return first == 1 ? ByteOrder::little : ByteOrder::big;
}

inline std::uint16_t reversed(std::uint16_t bits) { return __builtin_bswap16(bits); }
inline std::uint32_t reversed(std::uint32_t bits) { return __builtin_bswap32(bits); }
inline std::uint64_t reversed(std::uint64_t bits) { return __builtin_bswap64(bits); }

/// Makes `count` values, which lie as `order` says, values of this machine.
template <class T>
void to_machine_order(T* values, std::size_t count, ByteOrder order) {
  if constexpr (sizeof(T) > 1) {
    if (order == byte_order_of_machine()) return;
    using Bits = std::conditional_t<sizeof(T) == 2, std::uint16_t,
                                    std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>>;
    for (std::size_t k = 0; k < count; ++k) {
      Bits bits;
      std::memcpy(&bits, values + k, sizeof(T));
      bits = reversed(bits);
      std::memcpy(values + k, &bits, sizeof(T));
    }
  }
}

}  // namespace gale::io::detail
