#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include <gale/base/memory.hpp>
#include <gale/base/parallel.hpp>
#include <gale/export.hpp>

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

/// Copies `bytes` bytes between ordinary host memory and the device, at the bandwidth of pinned memory: up to 16
/// host threads copy through 2 MiB each. Waits first for what is enqueued on WorkerSpace(), which may have
/// made the data, and returns when it is done. Calls on several threads share the way. Without a device both are host
/// memory.
GALE_EXPORT void copy_to_device(void* device, const void* host, std::size_t bytes);
GALE_EXPORT void copy_from_device(void* host, const void* device, std::size_t bytes);

namespace detail {

/// copy_from_device of what was made before, while kernels and other threads go on: by few threads, so that most cores
/// are left to these.
GALE_EXPORT void copy_meanwhile(void* host, const void* device, std::size_t bytes);

}  // namespace detail

/// Copies bytes that write(to, begin, size) puts at `to` as they are wanted: `size` of them from the begin-th on,
/// on the threads of a copy; both are multiples of 1 MiB, but for the last size.
GALE_EXPORT void write_to_device(void* device, std::size_t bytes,
                                 const std::function<void(char* to, std::size_t begin, std::size_t size)>& write);

/// Takes the pinned memory of these for so many threads, and for some of a copy beside, which else the first copies do.
GALE_EXPORT void prepare_copies(int threads);

/// The contents of a View in `Memory`, the host's or the workers': the View itself if they can be read there already,
/// else a copy.
template <class Memory, class T, class... Properties>
auto in_memory(const Kokkos::View<T, Properties...>& view) {
  using Given = Kokkos::View<T, Properties...>;
  static_assert(int(Given::rank_dynamic) == 1, "extents but the first are constants");
  using There = Kokkos::View<T, typename Given::array_layout, Memory>;
  if constexpr (is_device_memory<typename Given::memory_space> == is_device_memory<Memory>) {
    return There(view);
  } else {
    const std::string label = view.label();  // a caller's View may have none
    const auto copy = allocate<typename There::non_const_type>(label.empty() ? "GALE::copy" : label, view.extent(0));
    constexpr auto copy_bytes = is_device_memory<Memory> ? copy_to_device : copy_from_device;
    copy_bytes(copy.data(), view.data(), view.size() * sizeof(typename Given::value_type));
    return There(copy);
  }
}

/// The contents of a View where the workers can read them.
template <class T, class... Properties>
auto on_worker(const Kokkos::View<T, Properties...>& view) {
  return in_memory<WorkerMemory>(view);
}

/// The contents of a View where the host can read them.
template <class T, class... Properties>
auto on_host(const Kokkos::View<T, Properties...>& view) {
  return in_memory<HostMemory>(view);
}

/// The entries of an array in either memory, in a vector. From a device they come right there.
template <class T, class Memory>
std::vector<std::remove_const_t<T>> vector_of(const Kokkos::View<T*, Memory>& array) {
  auto entries = detail::unwritten<std::remove_const_t<T>>(array.extent(0));
  if constexpr (is_device_memory<Memory>) {
    copy_from_device(entries.data(), array.data(), entries.size() * sizeof(T));
  } else {
    std::copy(array.data(), array.data() + array.extent(0), entries.begin());
  }
  return entries;
}

/// The entries of a vector in `Memory`: themselves, as long as they are there, or a copy.
template <class Memory, class T>
Array<const T, Memory> in_memory(const std::vector<T>& entries) {
  return in_memory<Memory>(Array<const T, HostMemory>(entries.data(), entries.size()));
}

}  // namespace gale
