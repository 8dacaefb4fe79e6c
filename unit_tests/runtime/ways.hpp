#pragma once

#include <memory>
#include <vector>

#include <gale/baselines/task_parallel_structure.hpp>
#include <gale/runtime/make_structure.hpp>

namespace gale::test {

/// A way for a runtime to work.
struct NamedWay {
  const char* name;
  StructureOptions options;
  bool is_task_parallel = false;

  std::unique_ptr<Structure> make(const Mesh& mesh, RelationSet relations) const {
    return is_task_parallel ? baselines::make_task_parallel_structure(mesh, relations)
                            : make_structure(mesh, relations, options);
  }
};

/// Everything that can be told apart about how a runtime works.
inline std::vector<NamedWay> ways() {
  std::vector<NamedWay> all(7);
  all[0].name = "consumers";
  all[0].options.way = Way::inline_;
  all[1].name = "leaders";
  all[1].options.way = Way::leaders;
  all[2].name = "leaders, a queue for each relation, a tiny budget";
  all[2].options.way = Way::leaders;
  all[2].options.queues = Queues::per_relation;
  all[2].options.host_memory = 16384;
  all[3].name = "leaders, one segment a request";
  all[3].options.way = Way::leaders;
  all[3].options.blocks_per_request = all[3].options.threads_per_block = 1;
  all[4].name = "pairs";
  all[4].is_task_parallel = true;
  all[5].name = "helpers, on sixteen cores";
  all[5].options.way = Way::helpers;
  all[5].options.cores = 16;
  all[6].name = "automatic";
  return all;
}

}  // namespace gale::test
