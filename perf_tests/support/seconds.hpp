#pragma once

#include <chrono>

namespace gale::perf {

/// Seconds that `action` takes.
template <class Action>
double seconds_of(const Action& action) {
  const auto begin = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace gale::perf
