#include <algorithm>
#include <cstdlib>
#include <limits>

#include <gale/base/cpu_quota.hpp>
#include <gale/base/threads.hpp>

namespace gale {

namespace {

constexpr int no_limit = std::numeric_limits<int>::max();

/// What the application chose; 0 if it chose nothing.
std::atomic<int> chosen_threads{0};

/// The least of the ThreadLimits that live on this thread.
thread_local int limit_here = no_limit;

/// The first number of OMP_NUM_THREADS, which may be a list; 0 if it isn't set.
int asked_of_openmp() {
  const char* const text = std::getenv("OMP_NUM_THREADS");
  return text == nullptr ? 0 : std::max(std::atoi(text), 0);
}

int default_threads() {
  static const int cores = detail::available_cores();
  static const int asked = asked_of_openmp();
#ifdef GALE_ENABLE_STD_THREADS
  return asked > 0 ? asked : cores;
#else
  return asked > 0 ? omp_get_max_threads() : std::min(omp_get_max_threads(), cores);
#endif
}

}  // namespace

int host_threads() {
  const int chosen = chosen_threads.load(std::memory_order_relaxed);
  return std::min(chosen > 0 ? chosen : default_threads(), limit_here);
}

void set_host_threads(int count) {
  count = std::max(count, 1);
  chosen_threads = count;
#ifndef GALE_ENABLE_STD_THREADS
  omp_set_num_threads(count);  // for other users of OpenMP on this thread, such as Kokkos
#endif
}

ThreadLimit::ThreadLimit(int threads) : before_(limit_here) { limit_here = std::min(before_, std::max(threads, 1)); }
ThreadLimit::~ThreadLimit() { limit_here = before_; }

}  // namespace gale
