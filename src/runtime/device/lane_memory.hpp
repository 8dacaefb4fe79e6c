#pragma once

#include <mutex>
#include <vector>

#include <gale/base/transfer.hpp>
#include <gale/relations/kernels/segment_kernel.hpp>
#include <gale/runtime/device/segment_batches.hpp>

namespace gale::detail {

/// What the kernels of a batch say beside the blocks.
struct BatchHeader {
  Offset used = 0;
  StarSizes needed[SegmentBatches<HostMemory>::most_kernels];
};

/// What one batch at a time is made in: an instance, and arrays that grow.
template <class Memory>
struct LaneMemory {
  using Space = typename SegmentKernel<Memory>::Space;

  Space instance;
  Array<BatchHeader, Memory> header;
  PinnedArray<BatchHeader> header_copy;
  PinnedArray<Id> segments_copy;
  Array<Id, Memory> segments, words;
  Array<Offset, Memory> directory;

  std::size_t bytes() const { return (segments.extent(0) + words.extent(0) + 2 * directory.extent(0)) * sizeof(Id); }
};

/// The memory of lanes that have nothing to do, for the next sweep, until Kokkos is finalized: on a device it takes
/// longer to make than a sweep over a small mesh. Large ones aren't kept.
template <class Memory>
class KeptLanes {
 public:
  static KeptLanes& instance();

  LaneMemory<Memory> take();
  void give_back(LaneMemory<Memory> memory);

 private:
  static constexpr std::size_t most_lanes = 3, most_bytes = std::size_t(48) << 20;

  std::mutex mutex_;
  std::vector<LaneMemory<Memory>> lanes_;
  bool hooked_ = false;  ///< to Kokkos' end
};

}  // namespace gale::detail
