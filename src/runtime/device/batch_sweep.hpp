#pragma once

#include <memory>
#include <optional>

#include <gale/export.hpp>
#include <gale/mesh/mesh.hpp>
#include <gale/runtime/batches/segment_batches.hpp>
#include <gale/runtime/sweep_options.hpp>

namespace gale::detail {

/// Throws gale::Error for no relation at all, and for an option below 0.
GALE_EXPORT void require_sweep(RelationSet relations, const DeviceSweepOptions& options);

/// Has the rows of all segments of a mesh made, batch after batch, for kernels that read them where they are made.
/// Several batches are under way: while one is read, the next is made.
template <class Memory>
class GALE_EXPORT BatchSweep {
 public:
  using Space = SpaceOf<Memory>;

  /// A batch that was launched: what reads its blocks is to be enqueued on `instance`, and leaves out segments that
  /// aren't there; they come again in a later batch.
  struct Launched {
    Space instance;
    SegmentBatches<Memory> blocks;
  };

  /// Throws as require_sweep does, and OutOfMemory if not even one segment has room.
  BatchSweep(const Mesh& mesh, RelationSet relations, const DeviceSweepOptions& options);

  /// Waits for all that is under way.
  ~BatchSweep();
  BatchSweep(const BatchSweep&) = delete;
  BatchSweep& operator=(const BatchSweep&) = delete;

  /// Calls use(launched) for each batch. When it returns, all is done.
  template <class Use>
  void run(const Use& use) {
    while (const std::optional<Launched> launched = next()) use(*launched);
  }

 private:
  /// The next batch; nothing when all are done.
  std::optional<Launched> next();

  class Batches;
  const std::unique_ptr<Batches> batches_;
};

}  // namespace gale::detail
