#pragma once

#include <mutex>

#include <gale/runtime/inline/inline_structure.hpp>

namespace gale::detail {

/// Way::helpers: inline; and in a sweep, helpers on the cores that it leaves idle compute ahead of the consumers.
class HelpedStructure : public InlineStructure {
 public:
  /// Throws gale::Error for a number of cores below 0.
  HelpedStructure(const Mesh& mesh, RelationSet relations, const StructureOptions& options);

 protected:
  std::unique_ptr<Sweep> begin_sweep(RelationSet wanted, int consumers, const SegmentBody& body) override;
  void add_statistics(StructureStatistics& all) const override;

 private:
  class HelpedTurns;

  const StructureOptions options_;
  mutable std::mutex mutex_;
  HelperStatistics helpers_;
  std::size_t host_bytes_ = 0;
};

}  // namespace gale::detail
