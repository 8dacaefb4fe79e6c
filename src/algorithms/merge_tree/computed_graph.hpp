#pragma once

#include <functional>

#include <gale/algorithms/merge_tree.hpp>
#include <gale/algorithms/merge_tree/extremum_graph.hpp>
#include <gale/runtime/computation.hpp>

namespace gale::detail {

/// Finds the graph where there is room, and returns use(space, graph, structure), which runs there: of a grid from the
/// keys alone, else by kernels or in a sweep. `structure()` has the rows that the graph is of; empty of a grid, where
/// each vertex's are computed.
template <class Use>
auto with_extremum_graph(Computing& computing, const VertexOrder& order, const ComputeOptions& options,
                         const Use& use) {
  const WorkerSpace worker;
  const HostExecutionSpace host;
  using Structures = std::function<Structure&()>;
  if (computing.is_of_grid()) {
    return computing.find_alone(
        [&](const DeviceSweepOptions&) {
          return use(worker, extremum_graph_of_grid(worker, order, options), Structures());
        },
        [&] { return use(host, extremum_graph_of_grid(host, order, options), Structures()); });
  }
  return computing.find(
      merge_tree_relations,
      [&](const DeviceSweepOptions& sweep) {
        return use(worker, extremum_graph(worker, order, sweep),
                   Structures([&]() -> Structure& { return computing.structure(merge_tree_relations); }));
      },
      [&](Structure& structure) {
        return use(host, extremum_graph(structure, order.keys(), options),
                   Structures([&]() -> Structure& { return structure; }));
      });
}

}  // namespace gale::detail
