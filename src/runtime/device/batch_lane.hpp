#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <gale/runtime/device/lane_memory.hpp>
#include <gale/runtime/device/launch_batch.hpp>

namespace gale::detail {

/// A kernel of a sweep, and what its teams need.
template <class Memory>
struct SweepKernel {
  SegmentKernel<Memory> kernel;
  std::shared_ptr<const SegmentBounds> bounds;
};

/// Segments for one batch, and what they are known to need beyond the usual.
struct BatchPlan {
  Id begin = 0, end = 0;           ///< of the interval that they are; none of it if they are what others lacked
  LaunchOrder order;               ///< they; empty where they are an interval of which none is large
  Offset words = 0;                ///< room for so many at least
  std::vector<StarSizes> scratch;  ///< by kernel; none: the usual

  bool is_interval() const { return order.segments.empty(); }
  Id count() const { return is_interval() ? end - begin : static_cast<Id>(order.segments.size()); }
  Id segment(Id slot) const { return is_interval() ? begin + slot : order.segments[slot]; }
};

/// What a batch took and lacked.
struct BatchShortfall {
  std::vector<Id> segments;        ///< that haven't all their blocks
  Offset words = 0;                ///< that the blocks of all its segments take
  std::vector<StarSizes> scratch;  ///< by kernel: what the missing ones need
};

/// One batch at a time, on an instance of its own, in memory of its own.
template <class Memory>
class BatchLane {
 public:
  using Space = typename SegmentKernel<Memory>::Space;

  /// Refers to the kernels. Throws OutOfMemory.
  BatchLane(const Mesh& mesh, std::vector<SweepKernel<Memory>>& kernels, Offset words);

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

  /// Waits for all that was enqueued on the instance since. Throws gale::Error if a relation has more entries in one
  /// segment than an Id counts.
  BatchShortfall finish();

 private:
  void reserve(Offset words, Id slots);
  SegmentList place_segments();
  void launch_kernels();
  void launch_kernel(int kernel, SegmentList segments, Offset* directory);
  std::vector<Id> segments_missing() const;

  std::vector<SweepKernel<Memory>>& kernels_;
  const Offset words_;  ///< that a batch has at least
  Offset relations_ = 0;
  LaneMemory<Memory> memory_;
  SegmentBatches<Memory> batches_;
  BatchPlan plan_;
  bool in_flight_ = false;
  bool is_worth_keeping_ = true;  ///< the memory, for another sweep
};

}  // namespace gale::detail
