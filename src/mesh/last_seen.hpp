#pragma once

#include <algorithm>
#include <cstdint>

#include <gale/base/types.hpp>

namespace gale::detail {

/// Tells most candidates that a row had before from others, without a look at all that it had.
class LastSeen {
 public:
  LastSeen() { std::fill(seen_, seen_ + size, ~std::uint64_t(0)); }

  /// False only if the row had the id before.
  bool is_new(Offset row, Id id) {
    std::uint64_t& last = seen_[static_cast<std::uint32_t>(id) % size];
    const std::uint64_t now = static_cast<std::uint64_t>(row) << 32 | static_cast<std::uint32_t>(id);
    if (last == now) return false;
    last = now;
    return true;
  }

 private:
  static constexpr std::uint32_t size = 64;
  std::uint64_t seen_[size];  ///< (row, id) by the id's lowest bits
};

}  // namespace gale::detail
