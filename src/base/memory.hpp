#pragma once

#include <cstdint>
#include <memory>
#include <new>
#include <string>

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include <gale/base/kokkos.hpp>

namespace gale {

/// A one-dimensional View whose data lies in `Memory`.
template <class T, class Memory>
using Array = Kokkos::View<T*, Memory>;

namespace detail {

/// Asks for 2 MiB pages, so that the first touch of a large array faults 512 times less. A hint: nothing depends on it.
inline void advise_huge_pages([[maybe_unused]] void* data, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  constexpr std::uintptr_t page = 4096;
  if (bytes < (std::size_t(4) << 20)) return;
  const auto begin = (reinterpret_cast<std::uintptr_t>(data) + page - 1) / page * page;
  const auto end = (reinterpret_cast<std::uintptr_t>(data) + bytes) / page * page;
  madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#endif
}

}  // namespace detail

/// Memory ran out; says for what. Kokkos throws this or that, by version and backend.
class OutOfMemory : public std::bad_alloc {
 public:
  explicit OutOfMemory(const std::string& what) : what_(std::make_shared<const std::string>(what)) {}
  const char* what() const noexcept override { return what_->c_str(); }

 private:
  std::shared_ptr<const std::string> what_;
};

/// An uninitialized View of the given extents; large ones on the host are backed by huge pages where the system has them. Throws OutOfMemory.
template <class ViewType, class... Extents>
ViewType allocate(const std::string& label, Extents... extents) {
  const ViewType view = [&] {
    try {
      return ViewType(Kokkos::view_alloc(label, Kokkos::WithoutInitializing), static_cast<std::size_t>(extents)...);
    } catch (const std::exception&) {
      const std::size_t bytes = ViewType::required_allocation_size(static_cast<std::size_t>(extents)...);
      throw OutOfMemory(std::string("out of memory: ") + ViewType::memory_space::name() + " has no " + std::to_string(bytes) + " bytes for " + label);
    }
  }();
  if constexpr (std::is_same_v<typename ViewType::memory_space, HostMemory>) {
    detail::advise_huge_pages(view.data(), view.span() * sizeof(typename ViewType::value_type));
  }
  return view;
}

}  // namespace gale
