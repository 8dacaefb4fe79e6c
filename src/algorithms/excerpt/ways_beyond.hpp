#pragma once

#include <array>
#include <vector>

#include <gale/algorithms/excerpt/reached.hpp>
#include <gale/algorithms/morse_smale/paths_on_ranks.hpp>

namespace gale::detail {

/// Where ways leave a rank's part: others know how they go on.
struct WayExits {
  ExitLinks vertices, cells;             ///< of falling and rising paths
  std::vector<std::array<Id, 2>> edges;  ///< from which edges fall, the higher ends first; some may fall here at first
};

/// Follows ways on from a rank's exits, for that rank. Received is what other ranks have found, in whose edges those
/// that are paired with a vertex are left out; entries of this rank itself are none. Places are as `reach` has them.
/// Edges fall in rounds of messages, as many as a way changes ranks; where paths do is known, so that each rank follows
/// its parts of them at once. `cells` are those that rise, of the same gradient. Collective.
Reached reach_beyond(const DiscreteGradient& gradient, const PathSimplices& cells, const WayExits& exits);

}  // namespace gale::detail
