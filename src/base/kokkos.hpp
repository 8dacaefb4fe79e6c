#pragma once

// All that GALE knows about differences between Kokkos versions (3.4.1, 4.4 to 5.x) and backends.

#include <string>
#include <vector>

#include <Kokkos_Core.hpp>

#include <gale/base/error.hpp>

namespace gale {

/// Throws gale::Error unless Kokkos is initialized. Every array and every loop of the library asks this first.
inline void require_kokkos() {
  if (Kokkos::is_initialized()) return;
  throw Error("Kokkos is not initialized: call Kokkos::initialize or make a Kokkos::ScopeGuard before using GALE");
}

/// Where workers compute relations: the device where Kokkos has one, else the host.
using WorkerSpace = Kokkos::DefaultExecutionSpace;

/// The memory of that space.
using WorkerMemory = WorkerSpace::memory_space;

/// The host's memory.
using HostMemory = Kokkos::HostSpace;

/// Kokkos' own on the host, for loops of GALE's, which run on all threads there (base/parallel.hpp). Where Kokkos has
/// no device, the same type as WorkerSpace.
using HostExecutionSpace = Kokkos::DefaultHostExecutionSpace;

/// The memory that an execution space works in.
template <class Space>
using MemoryOf = typename Space::memory_space;

/// An execution space to name where a caller's kernels are to run on all threads that GALE may use on the host
/// (host_threads()), whatever backends Kokkos has. Kokkos' own spaces run them as they promise: Kokkos::Serial on one
/// thread. What these threads share is changed by gale::atomic_add and its like (base/atomic.hpp): Kokkos' atomics are
/// none where Serial is its only backend.
struct HostThreads {
  using memory_space = HostMemory;  ///< where its kernels read and write
  void fence() const {}             ///< returns at once: what runs here is done when a call returns
};

/// instantiate(Space) for each space that a mesh may be made in: what is a template over the space is instantiated with
/// it in its source.
#if defined(KOKKOS_ENABLE_CUDA)
#define GALE_IN_EACH_SPACE(instantiate) \
  instantiate(WorkerSpace);             \
  instantiate(HostExecutionSpace)
#else
#define GALE_IN_EACH_SPACE(instantiate) instantiate(WorkerSpace)
#endif

/// Whether host code can't read what lies in `Memory`.
template <class Memory>
inline constexpr bool is_device_memory = !Kokkos::SpaceAccessibility<Kokkos::HostSpace, Memory>::accessible;

/// Whether `Space` runs somewhere else than on the host's threads.
template <class Space>
inline constexpr bool is_device = is_device_memory<typename Space::memory_space>;

/// Whether workers run on a device.
inline constexpr bool have_device = is_device<WorkerSpace>;

/// Host memory that the device copies to and from at full speed.
#if defined(KOKKOS_ENABLE_CUDA)
using PinnedMemory = Kokkos::CudaHostPinnedSpace;
#else
using PinnedMemory = Kokkos::HostSpace;
#endif

#if defined(KOKKOS_ENABLE_CUDA)
/// Has CUDA's own calls of this thread mean the device that Kokkos uses: a thread begins with the first of the machine.
inline void use_device() { cudaSetDevice(WorkerSpace().cuda_device()); }
#endif

/// A launch queue of its own on the device: work on two instances may overlap. On the host, the space itself. Throws
/// OutOfMemory if the device has no memory for one.
inline WorkerSpace make_instance() {
#if defined(KOKKOS_ENABLE_CUDA)
  try {
    return Kokkos::Experimental::partition_space(WorkerSpace(), std::vector<int>{1})[0];
  } catch (const std::exception& error) {
    cudaGetLastError();  // what this leaves behind is not the next call's
    if (std::string(error.what()).find("cudaErrorMemoryAllocation") == std::string::npos) throw;
    throw OutOfMemory("Cuda has no memory for another instance");
  }
#else
  return WorkerSpace();
#endif
}

/// The policy of a launch that overlaps with launches on other instances: its functor, of less than 4 KiB, travels with
/// the launch. In constant memory, where Kokkos::Cuda puts those of more than 512 bytes otherwise, there is one at a
/// time; larger ones are launched as always.
template <class Policy>
auto overlapping(const Policy& policy) {
  return Kokkos::Experimental::require(policy, Kokkos::Experimental::WorkItemProperty::HintLightWeight);
}

/// What an application gives Kokkos::initialize or a Kokkos::ScopeGuard, so that Kokkos' own loops on the host use so
/// many threads.
inline auto initialization_arguments(int threads) {
#if KOKKOS_VERSION >= 30700
  return Kokkos::InitializationSettings().set_num_threads(threads);
#else
  Kokkos::InitArguments arguments;
  arguments.num_threads = threads;
  return arguments;
#endif
}

/// "3.4.1"
inline std::string kokkos_version() {
  return std::to_string(KOKKOS_VERSION / 10000) + '.' + std::to_string(KOKKOS_VERSION / 100 % 100) + '.' +
         std::to_string(KOKKOS_VERSION % 100);
}

/// Tells Kokkos Tools about a loop that runs on our own threads, from construction to destruction.
class ToolsRegion {
 public:
  /// Begins a region of that name.
  explicit ToolsRegion(const char* label) {
    if (Kokkos::Tools::profileLibraryLoaded()) {
      Kokkos::Tools::beginParallelFor(label, 0, &id_);
      told_ = true;
    }
  }
  ~ToolsRegion() {
    if (told_) Kokkos::Tools::endParallelFor(id_);
  }
  ToolsRegion(const ToolsRegion&) = delete;
  ToolsRegion& operator=(const ToolsRegion&) = delete;

 private:
  std::uint64_t id_ = 0;
  bool told_ = false;
};

}  // namespace gale
