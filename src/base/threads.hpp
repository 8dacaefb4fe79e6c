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

#include <gale/base/stop.hpp>
#include <gale/export.hpp>

namespace gale {

/// How many threads a host loop, or a sweep unless told otherwise, uses when this thread begins it: what was set, else
/// what OMP_NUM_THREADS says, else what OpenMP would take, but no more than the cores that the process may run on and
/// than a container's CPU quota, rounded up. No more than this thread's ThreadLimits in any case.
GALE_EXPORT int host_threads();

/// From now on so many, at least 1, whichever thread begins a loop. For the application, before it begins: the library
/// never calls it.
GALE_EXPORT void set_host_threads(int count);

/// While it lives, loops that this thread begins use at most so many threads, at least 1; of several that live, the
/// least counts. To be destroyed on the thread that made it, last made first.
class GALE_EXPORT ThreadLimit {
 public:
  /// At most so many, at least 1, until it is destroyed.
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  int before_;
};

/// Calls `body(i)` for i in 0..count-1, each on a thread of its own as far as OpenMP grants them, and returns when all
/// have returned. The first exception that a body throws is thrown again here, after the others have ended. Loops that
/// a body begins run on its own thread. What asks this thread to stop asks the bodies.
template <class Body>
void on_threads(int count, const Body& body) {
  if (count <= 1) {
    body(0);
    return;
  }
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const StopRequest* const request = detail::stop_request();
  const auto guarded = [&](int i) {
    const ThreadLimit alone(1);
    const StopScope stoppable(request);
    try {
      body(i);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(failure_mutex);
      if (!failure) failure = std::current_exception();
    }
  };
#ifdef GALE_ENABLE_STD_THREADS
  std::vector<std::thread> others;
  int begun = 1;
  try {
    for (; begun < count; ++begun) others.emplace_back(guarded, begun);
  } catch (const std::exception&) {  // there are no more threads, or no memory for them: this one does the rest
  }
  guarded(0);
  for (int i = begun; i < count; ++i) guarded(i);
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
      for (std::int64_t i = next++; i < n; i = next++) {
        detail::stop_if_asked();
        body(thread, i);
      }
    } catch (...) {
      next = n;
      throw;
    }
  });
}

}  // namespace gale
