#pragma once

#include <memory>
#include <vector>

#include <gale/relations/kernels/segment_kernel.hpp>

namespace gale {

namespace detail {

/// A segment kernel on the calling thread, at the cost of a function call, in scratch memory of its own, which grows to
/// what the greediest segment so far has needed.
class HostKernel {
 public:
  /// `wanted` is one of the sets of `kernels_for`.
  HostKernel(const Mesh& mesh, RelationSet wanted) : kernel_(mesh, wanted) {}

  RelationSet wanted() const { return kernel_.wanted(); }

  /// Makes the blocks of a segment in a pool, whose directory is the segment's alone. They are missing if the pool
  /// lacks room; what lacks scratch memory runs again with more.
  void run(Id segment, const BlockPool& pool);

 private:
  void require_scratch(const StarSizes& sizes);

  SegmentKernel<HostMemory> kernel_;
  StarSizes sizes_;
  std::unique_ptr<char[]> scratch_;
};

}  // namespace detail

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

  /// Adds its rows to other rows of the same segment, valid as long.
  void compute(SegmentRows& rows);

  /// Allocated for blocks, now.
  std::size_t block_bytes() const;

 private:
  class BlockMaker;
  Mesh mesh_;
  std::vector<std::unique_ptr<BlockMaker>> makers_;
};

}  // namespace gale
