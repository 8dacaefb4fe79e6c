#pragma once

#include <memory>

#include <gale/mesh/mesh.hpp>
#include <gale/relations/relation.hpp>
#include <gale/runtime/batches/batch_lane.hpp>
#include <gale/runtime/leaders/block_store.hpp>

namespace gale::detail {

/// Makes one batch at a time for a leader. A leader has two or more, so that some make theirs while another's blocks
/// are copied.
class BatchWorker {
 public:
  virtual ~BatchWorker() = default;

  /// Begins to make the blocks of a plan's segments. Returns at once on a device. Throws OutOfMemory where the batch is
  /// too big for the device's memory.
  virtual void launch(const BatchPlan& plan) = 0;

  /// Waits until they are made, and begins to copy them to `arena`, which has as many words as the plan.
  virtual void begin_copy(Arena& arena) = 0;

  /// Waits until they are there: words, directory, and segments in whatever order.
  virtual BatchShortfall finish(Arena& arena) = 0;

  /// Waits for what was launched, and forgets it.
  virtual void abandon() noexcept = 0;

  virtual std::size_t device_bytes() const = 0;
};

/// How a worker works: see StructureOptions.
struct WorkerParameters {
  RelationSet wanted;  ///< what one kernel makes
  Offset words = 0;    ///< that a batch has, unless one segment needs more
  int threads_per_segment = 128;
};

/// A worker that computes on the calling thread when it finishes, straight into the arena.
std::unique_ptr<BatchWorker> make_host_worker(const Mesh& mesh, const WorkerParameters& parameters);

/// A worker that launches its batches in the space of `Memory`, and copies them from there. On the host one at a time.
template <class Memory>
std::unique_ptr<BatchWorker> make_launched_worker(const Mesh& mesh, const WorkerParameters& parameters);

}  // namespace gale::detail
