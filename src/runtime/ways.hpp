#pragma once

#include <memory>

#include <gale/export.hpp>
#include <gale/runtime/batches/host_worker.hpp>
#include <gale/runtime/structure.hpp>
#include <gale/runtime/structure_options.hpp>

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

/// Way::helpers: inline; and in a sweep, helpers on the cores that it leaves idle compute ahead of the consumers.
/// Throws gale::Error for a number of cores below 0.
std::unique_ptr<Structure> make_helped_structure(const Mesh& mesh, RelationSet relations,
                                                 const StructureOptions& options);

/// Way::leaders: consumers ask, leaders have batches computed, and run ahead of sweeps. Throws OutOfMemory where the
/// device has no room for what the leaders need.
std::unique_ptr<Structure> make_leader_structure(const Mesh& mesh, RelationSet relations,
                                                 const StructureOptions& options);

}  // namespace gale::detail
