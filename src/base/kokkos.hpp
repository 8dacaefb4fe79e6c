#pragma once

// All that GALE knows about differences between Kokkos versions (3.4.1, 4.4 to 5.x) and backends, but for the device's
// runtime, which is behind base/device.hpp.

#include <cstdint>
#include <string>

#include <Kokkos_Core.hpp>

#include <gale/base/error.hpp>

/// Defined where workers run on a device, for what `have_device` can't tell: code that is there or isn't.
#if defined(KOKKOS_ENABLE_CUDA) || defined(KOKKOS_ENABLE_HIP)
#define GALE_HAS_DEVICE
#endif

/// Defined in code that is compiled for the device.
#if defined(__CUDA_ARCH__) || defined(__HIP_DEVICE_COMPILE__)
#define GALE_ON_DEVICE
#endif

/// Before a function for host and device that calls what it is given, which may be for the host alone: nvcc warns
/// without it.
#if defined(__CUDACC__)
#define GALE_CALLS_ANY _Pragma("nv_exec_check_disable")
#else
#define GALE_CALLS_ANY
#endif

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
#if defined(GALE_HAS_DEVICE)
#define GALE_IN_EACH_SPACE(instantiate) \
  instantiate(WorkerSpace);             \
  instantiate(HostExecutionSpace)
#else
#define GALE_IN_EACH_SPACE(instantiate) instantiate(WorkerSpace)
#endif

/// Whether host code can't read what lies in `Memory`.
template <class Memory>
inline constexpr bool is_device_memory = !Kokkos::SpaceAccessibility<Kokkos::HostSpace, Memory>::accessible;

/// The space of GALE's that works in `Memory`.
template <class Memory>
using SpaceOf = std::conditional_t<is_device_memory<Memory>, WorkerSpace, HostExecutionSpace>;

/// Whether `Space` runs somewhere else than on the host's threads.
template <class Space>
inline constexpr bool is_device = is_device_memory<typename Space::memory_space>;

/// Whether workers run on a device.
inline constexpr bool have_device = is_device<WorkerSpace>;

/// Whether that is a device of NVIDIA's, by whose names other programs hand over arrays in its memory.
#if defined(KOKKOS_ENABLE_CUDA)
inline constexpr bool device_is_cuda = true;
#else
inline constexpr bool device_is_cuda = false;
#endif

/// Lanes of a warp, which go through a kernel together.
#if defined(KOKKOS_ENABLE_HIP)
inline constexpr int lanes_per_warp = 64;
#else
inline constexpr int lanes_per_warp = 32;
#endif

/// Host memory that the device copies to and from at full speed.
#if defined(KOKKOS_ENABLE_CUDA)
using PinnedMemory = Kokkos::CudaHostPinnedSpace;
#elif defined(KOKKOS_ENABLE_HIP)
using PinnedMemory = Kokkos::HIPHostPinnedSpace;
#else
using PinnedMemory = Kokkos::HostSpace;
#endif

/// The policy of a launch that overlaps with launches on other instances: its functor, of less than 4 KiB, travels with
/// the launch. In constant memory, where Kokkos::Cuda puts those of more than 512 bytes otherwise, there is one at a
/// time: who launches the next waits until this one's kernel is done.
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

namespace detail {

/// Whether this code is compiled for the device: a constant, by which the compiler drops what is for elsewhere.
KOKKOS_FORCEINLINE_FUNCTION constexpr bool compiled_for_device() {
#if defined(GALE_ON_DEVICE)
  return true;
#else
  return false;
#endif
}

/// Waits for what was enqueued on an execution space. Kokkos Tools are told the label.
template <class Space>
void wait_for(const Space& space, [[maybe_unused]] const char* label) {
#if KOKKOS_VERSION >= 40000
  space.fence(label);
#else
  space.fence();
#endif
}

/// Sets whether the calling thread counts references to Views, as long as it lives. Kokkos counts without atomics where
/// Serial is its only backend; our own threads share Views there too.
class ViewTracking {
 public:
  explicit ViewTracking(bool on) : was_on_(Record::tracking_enabled() != 0) { set(on); }
  ~ViewTracking() { set(was_on_); }
  ViewTracking(const ViewTracking&) = delete;
  ViewTracking& operator=(const ViewTracking&) = delete;

 private:
  using Record = Kokkos::Impl::SharedAllocationRecord<void, void>;

  static void set(bool on) { on ? Record::tracking_enable() : Record::tracking_disable(); }

  const bool was_on_;
};

/// Copies of Views made meanwhile own nothing.
struct UntrackedViews : ViewTracking {
  UntrackedViews() : ViewTracking(false) {}
};

/// For what is made to last, e.g. the first time that somebody needs it, wherever that is.
struct TrackedViews : ViewTracking {
  TrackedViews() : ViewTracking(true) {}
};

/// An address in a team's scratch memory of level 0, of which the compiler knows then that it is one.
KOKKOS_FORCEINLINE_FUNCTION void* in_shared_memory(void* address) {
#if defined(__CUDA_ARCH__)
  return __cvta_shared_to_generic(__cvta_generic_to_shared(address));
#else
  return address;
#endif
}

/// Four 32-bit integers in one load, on a device through its cache for what is only read. They are aligned to 16 bytes,
/// and nothing writes them while a kernel runs.
template <class Four>
KOKKOS_FORCEINLINE_FUNCTION Four load_four(const Four* from) {
  static_assert(sizeof(Four) == 16 && alignof(Four) == 16, "one load");
#if defined(GALE_ON_DEVICE)
  const int4 four = __ldg(reinterpret_cast<const int4*>(from));
  return {four.x, four.y, four.z, four.w};
#else
  return *from;
#endif
}

/// A bit for each lane of a warp.
#if defined(KOKKOS_ENABLE_HIP)
using LaneMask = unsigned long long;
#else
using LaneMask = unsigned;
#endif

/// The lanes of this warp that are here together.
KOKKOS_FORCEINLINE_FUNCTION LaneMask lanes_here() {
#if defined(__CUDA_ARCH__)
  return __activemask();
#elif defined(__HIP_DEVICE_COMPILE__)
  return __ballot(1);
#else
  return 1;
#endif
}

/// Lanes of this warp meet. On HIP they never part.
KOKKOS_FORCEINLINE_FUNCTION void meet([[maybe_unused]] LaneMask lanes = ~LaneMask(0)) {
#if defined(__CUDA_ARCH__)
  __syncwarp(lanes);
#endif
}

}  // namespace detail

}  // namespace gale
