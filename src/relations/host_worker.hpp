#pragma once

#include <memory>

#include <gale/relations/batch.hpp>

namespace gale {

/// Computes relations segment by segment on the calling thread, with the kernels that the device runs. Its memory grows
/// to what the largest segment so far has needed, and is used again. One worker serves one thread; any number may work
/// at once.
class GALE_EXPORT HostWorker {
 public:
  /// Enumerates what `wanted` needs of the mesh's simplices, if it isn't there. The blocks of the last `kept` segments
  /// stay valid.
  HostWorker(const Mesh& mesh, RelationSet wanted, int kept = 1);
  ~HostWorker();
  HostWorker(HostWorker&&) noexcept;
  HostWorker& operator=(HostWorker&&) noexcept;

  /// The rows of a segment. Valid until the `kept`-th next call. Throws gale::Error if a relation has more entries
  /// there than an Id counts.
  SegmentRows compute(Id segment);

  /// Adds them to other rows of the same segment. Likewise.
  void compute(SegmentRows& rows);

  /// What one kernel left for a segment: a batch of one slot, and the words that its blocks take.
  struct Computed {
    Batch<HostMemory> batch;
    Offset words = 0;
  };

  /// Computes the batch of a worker whose relations one kernel makes (kernels_for).
  Computed compute_batch(Id segment);

  /// Allocated for blocks, now.
  std::size_t block_bytes() const;

 private:
  class Kernel;
  Mesh mesh_;
  std::vector<std::unique_ptr<Kernel>> kernels_;
};

}  // namespace gale
