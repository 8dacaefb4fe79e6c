#pragma once

#include <sys/resource.h>

#include <chrono>
#include <ctime>

namespace gale::perf {

/// Seconds that `action` takes.
template <class Action>
double seconds_of(const Action& action) {
  const auto begin = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Seconds that this process's threads have computed so far, all together: what other programs take from it by the
/// clock isn't in it.
inline double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Bytes of pages that the system has given this process so far.
inline double bytes_faulted() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 4096.0 * static_cast<double>(usage.ru_minflt);
}

}  // namespace gale::perf
