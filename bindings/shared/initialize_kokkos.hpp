#pragma once

#include <cstdlib>

#include <gale/base/error.hpp>
#include <gale/base/kokkos.hpp>
#include <gale/base/threads.hpp>
#include <gale/base/transfer.hpp>

namespace gale::bindings {

/// Initializes Kokkos for a host program that doesn't know it, with as many threads as `host_threads`, and where there
/// is a device what copies to it go through. False if somebody did that already, who ends it too. To be called by one
/// thread at a time.
inline bool initialize_kokkos() {
  if (Kokkos::is_initialized()) return false;
  setenv("KOKKOS_DISABLE_WARNINGS", "1", 0);  // such as on thread binding, which are not what standard error is for
  Kokkos::initialize(initialization_arguments(host_threads()));
  if constexpr (have_device) {
    try {
      prepare_copies(host_threads());
    } catch (const Error&) {  // the first copy tries again, and may do without
    }
  }
  return true;
}

}  // namespace gale::bindings
