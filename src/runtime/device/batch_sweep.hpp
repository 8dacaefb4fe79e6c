#pragma once

#include <deque>
#include <memory>
#include <vector>

#include <gale/export.hpp>
#include <gale/runtime/device/batch_lane.hpp>
#include <gale/runtime/device_sweep_options.hpp>

namespace gale::detail {

/// Has the rows of all segments of a mesh made, batch after batch, for kernels that read them where they are made.
/// Several batches are under way: while one is read, the next is made.
template <class Memory>
class GALE_EXPORT BatchSweep {
 public:
  using Space = typename SegmentKernel<Memory>::Space;

  /// A batch that was launched: what reads its blocks is to be enqueued on `instance`, and leaves out segments that
  /// aren't there; they come again in a later batch.
  struct Launched {
    const Space& instance;
    const SegmentBatches<Memory>& blocks;
  };

  /// Waits for what was enqueued on `space`. Throws gale::Error for a negative option, OutOfMemory if not even one
  /// segment has room.
  BatchSweep(const Space& space, const Mesh& mesh, RelationSet relations, const DeviceSweepOptions& options);

  /// Waits for all that is under way.
  ~BatchSweep();
  BatchSweep(const BatchSweep&) = delete;
  BatchSweep& operator=(const BatchSweep&) = delete;

  /// Calls use(launched) for each batch. When it returns, all is done.
  template <class Use>
  void run(const Use& use) {
    while (BatchLane<Memory>* const lane = next()) use(Launched{lane->instance(), lane->launched()});
  }

  /// Vertices of a segment, on average.
  double mean_vertices() const;

 private:
  using Lane = BatchLane<Memory>;

  Lane* next();
  bool has_plans() const { return !again_.empty() || ahead_ < mesh_.segments(); }
  BatchPlan next_plan();
  bool is_large(Id segment) const;
  void launch(Lane& lane, BatchPlan plan);
  void finish(Lane& lane);
  void plan_again(const BatchPlan& plan, BatchShortfall lacked);

  const Mesh mesh_;
  std::vector<SweepKernel<Memory>> kernels_;
  Array<Id, Memory> all_segments_;
  Offset words_;             ///< that a batch has room for, unless one segment needs more
  double words_per_vertex_;  ///< that blocks take, by those so far
  std::vector<std::unique_ptr<Lane>> lanes_;
  std::size_t turn_ = 0;  ///< the lane that is next
  Id ahead_ = 0;          ///< the first segment that no batch had yet
  std::deque<BatchPlan> again_;
};

}  // namespace gale::detail
