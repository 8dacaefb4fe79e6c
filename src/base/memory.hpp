#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <gale/base/error.hpp>
#include <gale/base/kokkos.hpp>
#include <gale/export.hpp>

namespace gale {

/// A one-dimensional View whose data lies in `Memory`.
template <class T, class Memory>
using Array = Kokkos::View<T*, Memory>;

namespace detail {

/// Asks for 2 MiB pages, so that the first touch of a large array faults 512 times less: arrays that the device fills
/// are touched at the speed of the link. Without a device the system's choice stands: some virtual machines get huge
/// pages from their host one by one, four times slower than small ones. A hint: nothing depends on it.
GALE_EXPORT void advise_huge_pages(void* data, std::size_t bytes);

/// Has the system give the pages of memory that will be written, many at a time, on so many threads: a page among many
/// takes half of the time that it takes alone. A hint: nothing depends on it.
GALE_EXPORT void expect_writes(void* data, std::size_t bytes, int threads);

/// Lets the system have back the pages of memory that nobody will read. A hint, too.
GALE_EXPORT void give_back(void* data, std::size_t bytes);

/// Has Kokkos call `end` before it ends, for memory that is kept until then. On any thread, where Kokkos' own function
/// takes one at a time.
GALE_EXPORT void call_at_end(std::function<void()> end);

}  // namespace detail

/// Makes room for so many entries, in huge pages where those of `allocate` are: to fault in small ones costs some
/// systems more than to write what is in them.
template <class T>
void reserve(std::vector<T>& entries, std::size_t count) {
  entries.reserve(count);
  if constexpr (have_device) detail::advise_huge_pages(entries.data(), count * sizeof(T));
}

namespace detail {

/// A vector that can take entries without writing them: where these are many, one thread would need longer for zeros
/// than all threads for what is written over them. With libstdc++; other libraries' vectors write zeros.
template <class T>
class UnwrittenVector : public std::vector<T> {
  static_assert(std::is_trivially_copy_constructible_v<T> && std::is_trivially_destructible_v<T>, "bytes alone");

 public:
  /// Makes room for so many entries, see `reserve`, that are to be written on so many threads.
  UnwrittenVector(std::size_t count, int threads) {
    reserve(*this, count);
    expect_writes(this->data(), count * sizeof(T), threads);
#if defined(__GLIBCXX__) && !defined(_GLIBCXX_DEBUG) && !defined(_GLIBCXX_SANITIZE_VECTOR)
    this->_M_impl._M_finish = this->_M_impl._M_start + count;
#else
    this->resize(count);
#endif
  }
};

}  // namespace detail

/// The first entries of an array.
template <class View>
auto first_of(const View& array, std::size_t count) {
  return Kokkos::subview(array, std::make_pair(std::size_t(0), count));
}

/// An uninitialized View of the given extents; large ones on the host are backed by huge pages where the system has
/// them. Throws OutOfMemory, whatever Kokkos throws then, which differs by version and backend; gale::Error if Kokkos
/// isn't initialized.
template <class ViewType, class... Extents>
ViewType allocate(const std::string& label, Extents... extents) {
  require_kokkos();
  ViewType view = [&] {
    try {
      return ViewType(Kokkos::view_alloc(label, Kokkos::WithoutInitializing), static_cast<std::size_t>(extents)...);
    } catch (const std::exception&) {
      const std::size_t bytes = ViewType::required_allocation_size(static_cast<std::size_t>(extents)...);
      throw OutOfMemory(std::string(ViewType::memory_space::name()) + " has no " + std::to_string(bytes) +
                        " bytes for " + label);
    }
  }();
  if constexpr (have_device && std::is_same_v<typename ViewType::memory_space, HostMemory>) {
    detail::advise_huge_pages(view.data(), view.span() * sizeof(typename ViewType::value_type));
  }
  return view;
}

namespace detail {

/// An array of the host's that will be written from end to end.
template <class T>
Array<T, HostMemory> array_to_write(const std::string& label, std::size_t count, int threads) {
  const auto array = allocate<Array<T, HostMemory>>(label, count);
  expect_writes(array.data(), count * sizeof(T), threads);
  return array;
}

}  // namespace detail

/// Computes something in the workers' space, or on the host's threads if it doesn't fit the device's memory: returns
/// f(WorkerSpace()), or f(HostExecutionSpace()) if that throws OutOfMemory. What f returns is of the same type for
/// both. So a call of f that fails must leave nothing half done. With `worker` false, the host alone. `refused(error)`
/// is told why the device was given up.
template <class F, class Refused>
auto in_worker_or_host_space(bool worker, const F& f, const Refused& refused) {
  require_kokkos();
  if constexpr (have_device) {
    if (worker) {
      try {
        return f(WorkerSpace());
      } catch (const OutOfMemory& error) {
        refused(error);
      }
    }
  }
  return f(HostExecutionSpace());
}

/// Computes something there without asking why the device was given up.
template <class F>
auto in_worker_or_host_space(bool worker, const F& f) {
  return in_worker_or_host_space(worker, f, [](const OutOfMemory&) {});
}

}  // namespace gale
