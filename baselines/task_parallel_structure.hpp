#pragma once

#include <memory>

#include <gale/export.hpp>
#include <gale/runtime/structure.hpp>

namespace gale::baselines {

/// A structure that computes as ACTOPO does: in a sweep each consumer has a worker thread, which runs ahead of it.
/// Consumers that ask in any order compute for themselves. Reports name it "task-parallel". Throws as make_structure
/// does.
GALE_EXPORT std::unique_ptr<Structure> make_task_parallel_structure(const Mesh& mesh, RelationSet relations);

}  // namespace gale::baselines
