#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <thread>

#include <gale/algorithms/vertex_order.hpp>

namespace gale::app {

/// The most memory that this process has had resident so far, in bytes.
std::int64_t host_peak_bytes();

/// How long ago the system started this process, in seconds, by the clock; 0 where it doesn't say.
double process_age();

/// The processor seconds that this process has taken so far, on all threads, its own and the system's for it.
double processor_seconds();

/// The most memory that Kokkos has had allocated on the device since watch_device_memory(), in bytes; nothing without a
/// device.
std::optional<std::int64_t> device_peak_bytes();

/// Begins to count what Kokkos allocates on the device. To be called right after Kokkos is initialized.
void watch_device_memory();

/// Has memory that is freed stay with this process for what it allocates next, where the system's allocator can be told
/// so: else large arrays are given back at once, and each page of the next ones is cleared anew.
void keep_freed_memory();

/// Throws gale::Error unless the system starts so many threads: OpenMP would end the process.
void require_threads(int count);

/// Has the device do all that a command does, once, on a tiny mesh, while the input is read: the first time in a
/// process costs tens of milliseconds that have nothing to do with the input (kernels are loaded, memory is locked and
/// mapped). Where there is no device, nothing.
class WarmUp {
 public:
  WarmUp() = default;
  WarmUp(const WarmUp&) = delete;
  WarmUp& operator=(const WarmUp&) = delete;
  ~WarmUp() { wait(); }

  /// Begins, on a thread of its own; `run` gets the order of the tiny mesh's vertices, which are on the device. What
  /// fails here fails in the work, too, and is said there.
  void begin(std::function<void(const VertexOrder&)> run);

  void wait();

 private:
  std::thread thread_;
};

}  // namespace gale::app
