#pragma once

#include <gale/export.hpp>
#include <gale/runtime/batches/host_worker.hpp>
#include <gale/runtime/structure.hpp>

namespace gale::detail {

/// Way::inline_: each consumer computes what it misses.
class GALE_EXPORT InlineStructure : public Structure {
 public:
  InlineStructure(const Mesh& mesh, RelationSet relations, Way way = Way::inline_);

  std::unique_ptr<Consumer> consumer() override;

 protected:
  std::unique_ptr<Sweep> begin_sweep(RelationSet wanted, int consumers, const SegmentBody& body) override;
};

/// Computes a segment, and counts that.
SegmentRows compute_counted(HostWorker& worker, Id segment, ConsumerStatistics& statistics);

}  // namespace gale::detail
