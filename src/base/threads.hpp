#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>

#ifdef GALE_ENABLE_STD_THREADS
#include <thread>
#include <vector>
#else
#include <omp.h>
#endif

namespace gale {

#ifdef GALE_ENABLE_STD_THREADS
namespace detail {
inline int chosen_host_threads = 0;
}
#endif

/// How many threads a host loop or a sweep uses unless told otherwise: what OpenMP would take.
inline int host_threads() {
#ifdef GALE_ENABLE_STD_THREADS
  const int count = static_cast<int>(std::thread::hardware_concurrency());
  return detail::chosen_host_threads > 0 ? detail::chosen_host_threads : count > 0 ? count : 1;
#else
  return omp_get_max_threads();
#endif
}

/// From now on so many, at least 1. For the application, before it begins: the library never calls it.
inline void set_host_threads(int count) {
#ifdef GALE_ENABLE_STD_THREADS
  detail::chosen_host_threads = count;
#else
  omp_set_num_threads(count);
#endif
}

/// Calls `body(i)` for i in 0..count-1, each on a thread of its own as far as OpenMP grants them, and returns when all
/// have returned. The first exception that a body throws is thrown again here, after the others have ended.
template <class Body>
void on_threads(int count, const Body& body) {
  if (count <= 1) {
    body(0);
    return;
  }
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto guarded = [&](int i) {
    try {
      body(i);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(failure_mutex);
      if (!failure) failure = std::current_exception();
    }
  };
#ifdef GALE_ENABLE_STD_THREADS
  std::vector<std::thread> others;
  for (int i = 1; i < count; ++i) others.emplace_back(guarded, i);
  guarded(0);
  for (auto& thread : others) thread.join();
#else
#pragma omp parallel num_threads(count)
  for (int i = omp_get_thread_num(); i < count; i += omp_get_num_threads()) guarded(i);
#endif
  if (failure) std::rethrow_exception(failure);
}

/// Calls `body(thread, i)` for i in 0..n-1, each on one of `count` threads, which take what is next when they are done:
/// for work whose parts differ much. Exceptions as above; no further part is begun after one.
template <class Body>
void in_turns(int count, std::int64_t n, const Body& body) {
  std::atomic<std::int64_t> next{0};
  on_threads(count < n ? count : static_cast<int>(n), [&](int thread) {
    try {
      for (std::int64_t i = next++; i < n; i = next++) body(thread, i);
    } catch (...) {
      next = n;
      throw;
    }
  });
}

}  // namespace gale
