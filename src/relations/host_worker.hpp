#pragma once

#include <memory>

#include <gale/mesh/mesh.hpp>
#include <gale/relations/relation.hpp>
#include <gale/relations/segment_rows.hpp>

namespace gale {

/// Computes relations segment by segment on the calling thread, with the kernels that the device runs. Its memory grows
/// to what the largest segment so far has needed, and is used again. One worker serves one thread; any number may work
/// at once.
class HostWorker {
 public:
  /// Enumerates what `wanted` needs of the mesh' simplices, if it isn't there. The blocks of the last `kept` segments
  /// stay valid.
  HostWorker(const Mesh& mesh, RelationSet wanted, int kept = 1);
  ~HostWorker();
  HostWorker(HostWorker&&) noexcept;
  HostWorker& operator=(HostWorker&&) noexcept;

  /// The blocks of a segment. Valid until the `kept`-th next call.
  SegmentRows compute(Id segment);

  /// Adds them to other rows of the same segment. Likewise.
  void compute(SegmentRows& rows);

  /// Allocated for blocks, now.
  std::size_t block_bytes() const;

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace gale
