#pragma once

#include <utility>
#include <vector>

#include <gale/algorithms/merge_tree.hpp>
#include <gale/algorithms/merge_tree/extremum_graph.hpp>
#include <gale/base/mirrored.hpp>

namespace gale::detail {

/// One side of an ExtremumGraph, in whichever memory it was found.
struct MirroredGraphSide {
  Mirrored<Id> next;
  std::vector<Id> extrema;
  std::vector<Meeting> meetings;

  MirroredGraphSide() = default;

  template <class Memory>
  explicit MirroredGraphSide(ExtremumGraphSide<Memory> side)
      : next(Array<const Id, Memory>(side.next)),
        extrema(std::move(side.extrema)),
        meetings(std::move(side.meetings)) {}
};

using MirroredGraph = std::array<MirroredGraphSide, 2>;

/// The trees of a mesh that lies on several ranks, from what each knows of the vertices that it owns: `next` of others
/// is elsewhere. Paths are followed from rank to rank; of a vertex where several meet a rank tells as far as it joins
/// what its others don't. That and all extrema are gathered on each rank, and make a graph with the same trees, by the
/// same way as on one. Collective; throws gale::Error on all ranks, before anything is sent, where there is no room.
std::vector<MergeTree> trees_on_ranks(const VertexOrder& order, MirroredGraph graph, const std::vector<Tree>& trees,
                                      const MergeTreeOptions& options);

}  // namespace gale::detail
