#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace gale::app {

/// The most memory that this process has had resident so far, in bytes.
std::int64_t host_peak_bytes();

/// The most memory that Kokkos has had allocated on the device since watch_device_memory(), in bytes; nothing without a
/// device.
std::optional<std::int64_t> device_peak_bytes();

/// Begins to count what Kokkos allocates on the device. To be called right after Kokkos is initialized.
void watch_device_memory();

/// The device's name, such as "NVIDIA H200"; nothing without a device.
std::optional<std::string> device_name();

/// Throws gale::Error unless the system starts so many threads: OpenMP would end the process.
void require_threads(int count);

}  // namespace gale::app
