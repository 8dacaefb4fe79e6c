#pragma once

#include <vector>

#include <gale/algorithms/merge_tree/compared_vertices.hpp>
#include <gale/algorithms/merge_tree/extremum_graph.hpp>

namespace gale::detail {

/// Where the paths of one side of an order end. Extrema are known by their places here.
template <class Memory>
struct FollowedPaths {
  /// Places among what is compared, as the side comes to them.
  std::vector<Id> extrema;

  /// Vertices where paths of several extrema meet, by their places among what is compared, with each of these; as the
  /// side comes to them.
  std::vector<Meeting> meetings;

  /// The extremum of each vertex: `end_at` its place (jump.hpp).
  Array<Id, Memory> ends;
};

/// Follows all paths of a side to their ends, by pointer jumping. Its extrema, and the vertices where paths meet, are
/// places in `compared`.
template <class Space>
FollowedPaths<MemoryOf<Space>> follow_paths(const Space& space, Side side, const ComparedVertices& compared,
                                            ExtremumGraphSide<MemoryOf<Space>> graph);

}  // namespace gale::detail
