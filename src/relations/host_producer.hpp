#pragma once

#include <memory>

#include <gale/mesh/mesh.hpp>
#include <gale/relations/relation.hpp>
#include <gale/relations/segment_rows.hpp>

namespace gale {

/// Computes star relations segment by segment on the calling thread, with the kernel that the device runs. Its memory grows to what the
/// largest segment so far has needed, and is used again. One producer serves one thread; any number may work at once.
class HostProducer {
 public:
  /// `wanted` within star_relations.
  HostProducer(const Mesh& mesh, RelationSet wanted);
  ~HostProducer();
  HostProducer(HostProducer&&) noexcept;
  HostProducer& operator=(HostProducer&&) noexcept;

  /// The blocks of a segment. Valid until the next call.
  SegmentRows compute(Id segment);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace gale
