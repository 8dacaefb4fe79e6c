#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include <gale/base/memory.hpp>
#include <gale/base/types.hpp>
#include <gale/export.hpp>

// The device's own runtime and its sorting, by what GALE wants of them: with base/kokkos.hpp all that is to be ported
// to another kind of device. Without a device, the host does what is asked for.

namespace gale {

/// Has calls of the device's runtime on this thread mean the device that Kokkos uses: a thread begins with the first of
/// the machine.
GALE_EXPORT void use_device();

/// What the device calls itself; nothing without one.
GALE_EXPORT std::optional<std::string> device_name();

/// A launch queue of its own on the device: work on two instances may overlap. On the host, the space itself. Throws
/// OutOfMemory if the device has no memory for one.
GALE_EXPORT WorkerSpace make_instance();

namespace detail {

/// Locks pages of host memory for the device to copy to and from at full speed; false if the system refuses.
bool lock_pages(void* memory, std::size_t bytes);
void unlock_pages(void* memory);

/// Copies to the device and back, one after the other: a stream alone, as an instance of Kokkos' takes ten times as
/// long to make.
class CopyStream {
 public:
  CopyStream();
  ~CopyStream();
  CopyStream(CopyStream&& other) noexcept;
  CopyStream& operator=(CopyStream&&) = delete;

  /// Begins a copy between the memories of host and device, which is done when wait() returns. Both throw gale::Error
  /// if it fails.
  void begin_copy(void* to, const void* from, std::size_t bytes) const;
  void wait() const;

 private:
  void* stream_ = nullptr;
};

/// The device's stable_sort_by_key and sort_rows (sort.hpp). Enqueued on the instance, but for
/// giving back their workspace, and looking for the bits in which keys differ, which wait. Not without a device.
void sort_by_key_on_device(const WorkerSpace& space, const Array<std::uint64_t, WorkerMemory>& keys,
                           const Array<Id, WorkerMemory>& values);
template <class Index>
void sort_rows_on_device(const WorkerSpace& space, const char* label, const Array<Index, WorkerMemory>& begin,
                         const Array<Id, WorkerMemory>& values);

}  // namespace detail

}  // namespace gale
