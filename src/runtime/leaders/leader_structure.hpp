#pragma once

#include <atomic>
#include <memory>

#include <gale/runtime/structure.hpp>

namespace gale::detail {

class Leaders;

/// Way::leaders: consumers ask, leaders have batches computed, and run ahead of sweeps.
class LeaderStructure : public Structure {
 public:
  /// Throws OutOfMemory where the device has no room for what the leaders need.
  LeaderStructure(const Mesh& mesh, RelationSet relations, const StructureOptions& options);

  /// Ends the leaders. A consumer that still waits gets a gale::Error.
  ~LeaderStructure() override;

  std::unique_ptr<Consumer> consumer() override;

 protected:
  std::unique_ptr<Sweep> begin_sweep(RelationSet wanted, int consumers, const SegmentBody& body) override;
  void add_statistics(StructureStatistics& all) const override;

 private:
  class LeaderSweep;

  const std::shared_ptr<Leaders> leaders_;
  std::atomic<bool> sweeping_{false};
};

}  // namespace gale::detail
