#pragma once

#include <algorithm>
#include <vector>

#include <gale/base/atomic.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

/// What the lanes of kernels append to, in no order, as long as there is room; the count goes on. Copies share it.
template <class T>
class DeviceList {
 public:
  DeviceList() = default;

  /// Empty. Throws OutOfMemory.
  DeviceList(const char* label, Offset capacity)
      : items_(allocate<Array<T, WorkerMemory>>(label, capacity)), count_("GALE::list_count", 1) {}

  KOKKOS_FUNCTION void add(const T& item) const {
    const Offset at = atomic_add(count_.data(), Offset(1));
    if (at < static_cast<Offset>(items_.extent(0))) items_(at) = item;
  }

  /// How many were appended, more than there is room for perhaps. Waits for all kernels.
  Offset count() const {
    Offset count = 0;
    Kokkos::deep_copy(count, Kokkos::subview(count_, 0));
    return count;
  }

  KOKKOS_FUNCTION const T& operator[](Offset i) const { return items_(i); }

  bool overflowed() const { return count() > static_cast<Offset>(items_.extent(0)); }

  /// The items that there was room for.
  std::vector<T> to_host() const {
    const auto size = std::min(static_cast<std::size_t>(count()), items_.extent(0));
    const auto there = on_host(first_of(items_, size));
    return {there.data(), there.data() + size};
  }

 private:
  Array<T, WorkerMemory> items_;
  Array<Offset, WorkerMemory> count_;
};

}  // namespace gale::detail
