#pragma once

#include <gale/base/kokkos.hpp>

namespace gale {

/// Adds to what several threads share, relaxed, and returns what was there. Kokkos' own is no atomic on the host where
/// Serial is its only backend; our host loops run on several threads there too.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION T atomic_add(T* to, T value) {
#if defined(__CUDA_ARCH__)
  return Kokkos::atomic_fetch_add(to, value);
#else
  return __atomic_fetch_add(to, value, __ATOMIC_RELAXED);
#endif
}

/// Makes it `desired` if it is `expected`, relaxed, and returns what was there.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION T atomic_compare_exchange(T* at, T expected, T desired) {
#if defined(__CUDA_ARCH__)
  return Kokkos::atomic_compare_exchange(at, expected, desired);
#else
  __atomic_compare_exchange_n(at, &expected, desired, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED);
  return expected;
#endif
}

/// Reads and writes what other threads may be writing and reading, whole.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION T atomic_read(const T* from) {
#if defined(__CUDA_ARCH__)
  return *static_cast<const volatile T*>(from);
#else
  return __atomic_load_n(from, __ATOMIC_RELAXED);
#endif
}

template <class T>
KOKKOS_FORCEINLINE_FUNCTION void atomic_write(T* to, T value) {
#if defined(__CUDA_ARCH__)
  *static_cast<volatile T*>(to) = value;
#else
  __atomic_store_n(to, value, __ATOMIC_RELAXED);
#endif
}

}  // namespace gale
