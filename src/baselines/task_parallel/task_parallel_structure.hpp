#pragma once

#include <gale/runtime/inline/inline_structure.hpp>

namespace gale::detail {

/// Way::task_parallel: in a sweep each consumer has a worker thread, which runs ahead of it. Consumers that ask in any
/// order compute for themselves.
class TaskParallelStructure : public InlineStructure {
 public:
  TaskParallelStructure(const Mesh& mesh, RelationSet relations)
      : InlineStructure(mesh, relations, Way::task_parallel) {}

 protected:
  std::unique_ptr<Sweep> begin_sweep(RelationSet wanted, int consumers, const SegmentBody& body) override;
};

}  // namespace gale::detail
