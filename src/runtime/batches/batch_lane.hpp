#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include <gale/base/transfer.hpp>
#include <gale/relations/kernels/block_pool.hpp>
#include <gale/runtime/batches/batch_kernel.hpp>
#include <gale/runtime/batches/segment_batches.hpp>

namespace gale::detail {

/// Segments that are computed together, and what they are known to need beyond the usual.
struct BatchPlan {
  Id begin = 0, end = 0;           ///< the interval that they are, unless they are in the list
  std::vector<Id> segments;        ///< the list; empty: the interval
  Offset words = 0;                ///< room that their blocks have
  std::vector<StarSizes> scratch;  ///< by kernel, at least; none: the usual

  bool is_interval() const { return segments.empty(); }
  Id count() const { return is_interval() ? end - begin : static_cast<Id>(segments.size()); }
  Id segment(Id i) const { return is_interval() ? begin + i : segments[i]; }
};

/// What a batch took and lacked.
struct BatchShortfall {
  std::vector<Id> segments;        ///< that haven't all their blocks
  Offset words = 0;                ///< that the blocks of all its segments take
  std::vector<StarSizes> scratch;  ///< by kernel: what the missing ones need
};

/// What a batch lacks that couldn't be launched: everything.
inline BatchShortfall all_of(const BatchPlan& plan) {
  BatchShortfall lacked;
  for (Id i = 0; i < plan.count(); ++i) lacked.segments.push_back(plan.segment(i));
  return lacked;
}

/// What a batch lacked, to be tried again in two parts, or in one if it is one segment: with the scratch memory that it
/// needs and, for one segment, the room.
inline std::vector<BatchPlan> in_halves(const BatchPlan& plan, const BatchShortfall& lacked) {
  BatchPlan half;
  half.words = plan.words;
  half.scratch = plan.scratch;
  half.scratch.resize(std::max(plan.scratch.size(), lacked.scratch.size()));
  for (std::size_t k = 0; k < lacked.scratch.size(); ++k) half.scratch[k] = larger(half.scratch[k], lacked.scratch[k]);
  if (lacked.segments.size() == 1) half.words = std::max(half.words, lacked.words);
  std::vector<BatchPlan> halves;
  const auto begin = lacked.segments.begin(), end = lacked.segments.end(), middle = begin + (end - begin + 1) / 2;
  for (const auto& [from, to] : {std::make_pair(begin, middle), std::make_pair(middle, end)}) {
    if (from == to) continue;
    half.segments.assign(from, to);
    halves.push_back(half);
  }
  return halves;
}

/// What the kernels of a batch say beside the blocks.
struct BatchHeader {
  Offset used = 0;
  StarSizes needed[SegmentBatches<HostMemory>::most_kernels];
};

/// What a lane makes batches in: an instance, and arrays that grow.
template <class Memory>
struct BatchLaneMemory {
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
  BatchLaneMemory<Memory> memory_;
  SegmentBatches<Memory> batches_;
  BatchPlan plan_;
  LaunchOrder order_;  ///< of the plan's segments; none if it is an interval of which none is large
  bool in_flight_ = false;
  bool is_worth_keeping_;  ///< the memory, for another lane
};

}  // namespace gale::detail
