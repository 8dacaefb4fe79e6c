#pragma once

#include <vector>

#include <gale/algorithms/merge_tree/extremum_graph.hpp>
#include <gale/base/memory.hpp>

namespace gale::detail {

/// Where the paths of one side of an order end. Extrema are known by their places here.
template <class Memory>
struct FollowedPaths {
  std::vector<Id> extrema;  ///< GALE's vertices, as the side comes to them
  std::vector<Meeting>
      meetings;            ///< vertices where paths of several extrema meet, with each of these; as it comes there
  Array<Id, Memory> ends;  ///< of each vertex the extremum: `end_at` its place (jump.hpp)
};

/// Follows all paths of a side to their ends, by pointer jumping. `keys` are those of the host.
template <class Space>
FollowedPaths<MemoryOf<Space>> follow_paths(const Space& space, const SideKeys& keys,
                                            ExtremumGraphSide<MemoryOf<Space>> side);

}  // namespace gale::detail
