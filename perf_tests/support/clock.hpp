#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <gale/base/kokkos.hpp>

#include "support/seconds.hpp"

namespace gale::perf {

/// The median of an odd number of runs, after one that isn't counted.
template <class Action>
double median_seconds_of(int runs, const Action& action) {
  action();
  std::vector<double> times;
  for (int i = 0; i < runs; ++i) times.push_back(seconds_of(action));
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

/// What a record of a measurement begins with: Kokkos and backend.
inline std::string context() { return "Kokkos " + kokkos_version() + ", " + WorkerSpace::name(); }

/// Bytes per second of copies of `bytes` bytes from the workers' memory to pinned host memory, one after the other.
inline double link_bandwidth(std::size_t bytes) {
  const Kokkos::View<char*, WorkerMemory> from("GALE::link_from", bytes);
  const Kokkos::View<char*, PinnedMemory> to("GALE::link_to", bytes);
  const WorkerSpace space;
  constexpr int copies = 32;
  const double seconds = median_seconds_of(5, [&] {
    for (int i = 0; i < copies; ++i) Kokkos::deep_copy(space, to, from);
    space.fence();
  });
  return copies * static_cast<double>(bytes) / seconds;
}

}  // namespace gale::perf
