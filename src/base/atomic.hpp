#pragma once

#include <cstdint>
#include <type_traits>

#include <gale/base/kokkos.hpp>

// Atomics for kernels and loops in every execution space: on a device Kokkos' own, on the host the compiler's. Kokkos'
// are none on the host where Serial is its only backend, and GALE runs several threads there too (HostThreads, sweeps
// of a Structure).
//
// `T` is any type of 1, 2, 4 or 8 bytes that can be copied byte by byte; on a device one that Kokkos' atomics take.
// What changes something returns what was there before. All are relaxed: they order nothing else.

namespace gale {

namespace detail {

/// Writes `value` unless there is something else than `there`, which becomes that then.
template <class T>
bool replaced(T* at, T& there, T value) {
  return __atomic_compare_exchange(at, &there, &value, true, __ATOMIC_RELAXED, __ATOMIC_RELAXED);
}

/// Sets bits of a byte. A device changes words: the four bytes at a multiple of 4 that it is one of must be there.
KOKKOS_FORCEINLINE_FUNCTION std::uint8_t atomic_or(std::uint8_t* at, std::uint8_t bits) {
#if defined(GALE_ON_DEVICE)
  const auto byte = reinterpret_cast<std::uintptr_t>(at) % 4;
  const unsigned word = atomicOr(reinterpret_cast<unsigned*>(at - byte), unsigned(bits) << (8 * byte));
  return static_cast<std::uint8_t>(word >> (8 * byte));
#else
  return __atomic_fetch_or(at, bits, __ATOMIC_RELAXED);
#endif
}

/// Sets bits of a word.
KOKKOS_FORCEINLINE_FUNCTION std::uint64_t atomic_or(std::uint64_t* at, std::uint64_t bits) {
#if defined(GALE_ON_DEVICE)
  return atomicOr(reinterpret_cast<unsigned long long*>(at), static_cast<unsigned long long>(bits));
#else
  return __atomic_fetch_or(at, bits, __ATOMIC_RELAXED);
#endif
}

}  // namespace detail

/// Reads, whole, what other threads may be writing.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION T atomic_read(const T* from) {
#if defined(GALE_ON_DEVICE)
  return *static_cast<const volatile T*>(from);
#else
  T here;
  __atomic_load(from, &here, __ATOMIC_RELAXED);
  return here;
#endif
}

/// Writes, whole, what other threads may be reading.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION void atomic_write(T* to, std::common_type_t<T> value) {
#if defined(GALE_ON_DEVICE)
  *static_cast<volatile T*>(to) = value;
#else
  __atomic_store(to, &value, __ATOMIC_RELAXED);
#endif
}

/// Adds.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION T atomic_add(T* to, std::common_type_t<T> value) {
#if defined(GALE_ON_DEVICE)
  return Kokkos::atomic_fetch_add(to, value);
#else
  if constexpr (std::is_integral_v<T>) {
    return __atomic_fetch_add(to, value, __ATOMIC_RELAXED);
  } else {
    T there = atomic_read(to);
    while (!detail::replaced(to, there, static_cast<T>(there + value))) {
    }
    return there;
  }
#endif
}

/// Makes it at least `value`.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION T atomic_max(T* at, std::common_type_t<T> value) {
#if defined(GALE_ON_DEVICE)
  return Kokkos::atomic_fetch_max(at, value);
#else
  T there = atomic_read(at);
  while (there < value && !detail::replaced(at, there, value)) {
  }
  return there;
#endif
}

/// Makes it at most `value`.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION T atomic_min(T* at, std::common_type_t<T> value) {
#if defined(GALE_ON_DEVICE)
  return Kokkos::atomic_fetch_min(at, value);
#else
  T there = atomic_read(at);
  while (value < there && !detail::replaced(at, there, value)) {
  }
  return there;
#endif
}

/// Makes it `desired` if it is `expected`.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION T atomic_compare_exchange(T* at, std::common_type_t<T> expected,
                                                      std::common_type_t<T> desired) {
#if defined(GALE_ON_DEVICE)
  return Kokkos::atomic_compare_exchange(at, expected, desired);
#else
  __atomic_compare_exchange(at, &expected, &desired, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED);
  return expected;
#endif
}

/// Makes it `value`.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION T atomic_exchange(T* at, std::common_type_t<T> value) {
#if defined(GALE_ON_DEVICE)
  return Kokkos::atomic_exchange(at, value);
#else
  T before;
  __atomic_exchange(at, &value, &before, __ATOMIC_RELAXED);
  return before;
#endif
}

}  // namespace gale
