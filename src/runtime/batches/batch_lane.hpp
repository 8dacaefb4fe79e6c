#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <gale/base/transfer.hpp>
#include <gale/runtime/batches/batch_kernel.hpp>
#include <gale/runtime/batches/batch_plan.hpp>
#include <gale/runtime/batches/segment_batches.hpp>

namespace gale::detail {

/// What the kernels of a batch say beside the blocks.
struct BatchHeader {
  Offset used = 0;
  StarSizes needed[SegmentBatches<HostMemory>::most_kernels];
};

/// What a lane makes batches in: an instance, and arrays that grow.
template <class Memory>
struct LaneMemory {
  typename BatchKernel<Memory>::Space instance;
  Array<BatchHeader, Memory> header;
  PinnedArray<BatchHeader> header_copy;
  PinnedArray<Id> segments_copy;
  PinnedArray<Offset> directory_copy;
  Array<Id, Memory> segments, words;
  Array<Offset, Memory> directory;

  std::size_t bytes() const { return (segments.extent(0) + words.extent(0) + 2 * directory.extent(0)) * sizeof(Id); }
};

/// Who reads the batches of a lane.
enum class BatchReader {
  kernels,  ///< where they are made, in a sweep: its memory serves the next one's lanes, until Kokkos is finalized, as
            ///< on a device it takes longer to make than a sweep over a small mesh
  host      ///< copies, for which the batch's directory is brought there too; its memory goes with it
};

/// Makes one batch at a time by launches on an instance of its own, in memory of its own: several lanes overlap.
///
/// Used by one thread at a time; on the host only one lane of all is, as Kokkos' launches are there.
template <class Memory>
class BatchLane {
 public:
  using Space = typename BatchKernel<Memory>::Space;
  using Kernels = std::vector<BatchKernel<Memory>>;

  /// Takes room for the words of a usual batch. Throws OutOfMemory.
  BatchLane(const Mesh& mesh, std::shared_ptr<Kernels> kernels, Offset words, BatchReader reader);

  /// Waits for what is in flight.
  ~BatchLane();
  BatchLane(const BatchLane&) = delete;
  BatchLane& operator=(const BatchLane&) = delete;

  const Space& instance() const { return memory_.instance; }

  /// Begins to make the blocks of a batch, on a device without waiting. Throws OutOfMemory.
  void launch(BatchPlan plan);

  /// The launched batches, for what is enqueued on the same instance.
  const SegmentBatches<Memory>& launched() const { return batches_; }

  /// Was a batch launched that isn't finished?
  bool in_flight() const { return in_flight_; }
  const BatchPlan& plan() const { return plan_; }

  /// The segment in a slot of the batch.
  Id segment(Id slot) const { return order_.segments.empty() ? plan_.begin + slot : order_.segments[slot]; }

  /// Waits until the blocks are made, and begins to copy them to `words`, which has as much room as the plan.
  void begin_copy(const PinnedArray<Id>& words);

  /// Waits for all that was enqueued on the instance since. Throws gale::Error if a relation has more entries in one
  /// segment than an Id counts.
  BatchShortfall finish();

  /// Waits for what is in flight, and forgets it.
  void abandon() noexcept;

  /// Where the blocks begin, by slot and relation, on the host: of a finished batch that the host reads.
  const Offset* directory() const { return memory_.directory_copy.data(); }

  /// Bytes for blocks that batches so far have had.
  std::size_t bytes() const { return static_cast<std::size_t>(room_) * sizeof(Id); }

 private:
  void reserve(Offset words, Id slots);
  SegmentList place_segments();
  void launch_kernels();
  void launch_kernel(int kernel, SegmentList segments, Offset* directory);
  bool is_large(Id segment) const;
  std::vector<Id> segments_missing() const;

  const std::shared_ptr<Kernels> kernels_;
  const BatchReader reader_;
  Offset relations_ = 0;
  Offset room_ = 0;  ///< words
  LaneMemory<Memory> memory_;
  SegmentBatches<Memory> batches_;
  BatchPlan plan_;
  LaunchOrder order_;  ///< of the plan's segments; none if it is an interval of which none is large
  bool in_flight_ = false;
  bool is_worth_keeping_;  ///< the memory, for another lane
};

}  // namespace gale::detail
