#pragma once

#include <gale/base/kokkos.hpp>
#include <gale/base/types.hpp>

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

}  // namespace gale::detail
