#include <gale/base/device.hpp>
#include <gale/base/memory.hpp>
#include <gale/runtime/device/lane_memory.hpp>

namespace gale::detail {

namespace {

/// An instance of its own on a device; on the host there is nothing to overlap.
template <class Space>
Space lane_instance() {
  if constexpr (is_device<Space>) {
    return make_instance();
  } else {
    return {};
  }
}

}  // namespace

template <class Memory>
KeptLanes<Memory>& KeptLanes<Memory>::instance() {
  static KeptLanes kept;
  return kept;
}

template <class Memory>
LaneMemory<Memory> KeptLanes<Memory>::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!lanes_.empty()) {
    LaneMemory<Memory> memory = std::move(lanes_.back());
    lanes_.pop_back();
    return memory;
  }
  LaneMemory<Memory> memory;
  memory.instance = lane_instance<typename LaneMemory<Memory>::Space>();
  memory.header = allocate<Array<BatchHeader, Memory>>("GALE::sweep_header", 1);
  memory.header_copy = PinnedArray<BatchHeader>(1);
  return memory;
}

template <class Memory>
void KeptLanes<Memory>::give_back(LaneMemory<Memory> memory) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (lanes_.size() >= most_lanes || memory.bytes() > most_bytes) return;
  if (lanes_.empty() && !hooked_) {
    Kokkos::push_finalize_hook([] {
      instance().lanes_.clear();
      instance().hooked_ = false;
    });
    hooked_ = true;
  }
  lanes_.push_back(std::move(memory));
}

template class KeptLanes<WorkerMemory>;
#if defined(KOKKOS_ENABLE_CUDA)
template class KeptLanes<HostMemory>;
#endif

}  // namespace gale::detail
