#pragma once

#include <gale/base/error.hpp>
#include <gale/base/kokkos.hpp>

namespace gale {

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

template <class F>
auto in_worker_or_host_space(bool worker, const F& f) {
  return in_worker_or_host_space(worker, f, [](const OutOfMemory&) {});
}

}  // namespace gale
