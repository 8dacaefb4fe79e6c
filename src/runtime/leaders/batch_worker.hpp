#pragma once

#include <memory>
#include <vector>

#include <gale/mesh/mesh.hpp>
#include <gale/relations/kernels/block_pool.hpp>
#include <gale/relations/relation.hpp>
#include <gale/runtime/leaders/arena.hpp>

namespace gale::detail {

/// What a batch lacked, so that blocks of it are missing.
struct Shortfall {
  bool any = false;
  Offset words = 0;   ///< that all its blocks take; more than there were, or it isn't why
  StarSizes scratch;  ///< that its segments need
};

/// Computes one batch at a time. A leader has two or more, so that some compute while another's blocks are
/// copied.
class BatchWorker {
 public:
  virtual ~BatchWorker() = default;

  /// Begins to compute the blocks of `segments`, in `words` words, each with at least the scratch memory that `scratch`
  /// says. Returns at once on a device. Throws OutOfMemory where the batch is too big for the device's memory.
  virtual void launch(const std::vector<Id>& segments, Offset words, const StarSizes& scratch) = 0;

  /// Waits until it is computed, and begins to copy its blocks to `arena`, which has so many words.
  virtual void begin_copy(Arena& arena) = 0;

  /// Waits until they are there: words, directory, and segments in whatever order.
  virtual Shortfall finish(Arena& arena) = 0;

  /// Waits for what was launched, and forgets it. Never throws.
  virtual void abandon() noexcept = 0;

  virtual std::size_t device_bytes() const = 0;
};

/// How a worker works: see StructureOptions.
struct WorkerParameters {
  RelationSet wanted;
  Offset words = 0;  ///< that a batch has, unless one segment needs more
  int threads_per_segment = 128;
};

/// On the calling thread, when it finishes.
std::unique_ptr<BatchWorker> make_host_worker(const Mesh& mesh, const WorkerParameters& parameters);

/// On the device. Only where there is one.
std::unique_ptr<BatchWorker> make_device_worker(const Mesh& mesh, const WorkerParameters& parameters);

}  // namespace gale::detail
