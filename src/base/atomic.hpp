#pragma once

#include <gale/base/kokkos.hpp>

namespace gale {

/// Adds to what several threads share, relaxed, and returns what was there. Kokkos' own is no atomic on the host where Serial is its only
/// backend; our host loops run on several threads there too.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION T atomic_add(T* to, T value) {
#if defined(__CUDA_ARCH__)
  return Kokkos::atomic_fetch_add(to, value);
#else
  return __atomic_fetch_add(to, value, __ATOMIC_RELAXED);
#endif
}

}  // namespace gale
