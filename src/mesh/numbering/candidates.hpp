#pragma once

#include <algorithm>
#include <cstdint>

#include <gale/base/kokkos.hpp>
#include <gale/base/types.hpp>

// What a thread keeps of one row's candidates, which come in any order and many times.

namespace gale::detail {

/// A few distinct ids in ascending order, kept by one thread in its own memory.
class FewDistinct {
 public:
  static constexpr Id capacity = 40;
  static constexpr Id too_many = -1;

  KOKKOS_INLINE_FUNCTION void insert(Id id) {
    if (size_ == too_many) return;
    Id at = size_;
    while (at > 0 && ids_[at - 1] > id) --at;
    if (at > 0 && ids_[at - 1] == id) return;
    if (size_ == capacity) {
      size_ = too_many;
      return;
    }
    for (Id i = size_; i > at; --i) ids_[i] = ids_[i - 1];
    ids_[at] = id;
    ++size_;
  }

  /// How many; `too_many` once there were more than `capacity`.
  KOKKOS_INLINE_FUNCTION Id size() const { return size_; }
  KOKKOS_INLINE_FUNCTION Id operator[](Id i) const { return ids_[i]; }

 private:
  Id ids_[capacity];
  Id size_ = 0;
};

/// Tells most candidates that a row had before from others, without a look at all that it had. On the host.
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
