#pragma once

#include <array>
#include <limits>
#include <utility>
#include <vector>

#include <gale/algorithms/merge_tree/side_keys.hpp>

namespace gale::detail {

/// The arcs of contour trees, in the order in which they are pruned from leaves.
struct ContourArcs {
  std::vector<std::pair<Id, Id>> ends;  ///< the lower node and the upper one

  /// By side, of the arc from each node to its parent: the contour arc whose pruning took it away. A vertex lies on the
  /// first one that took away its arc of either side.
  std::array<std::vector<Id>, 2> taken_by;

  static constexpr Id nobody = std::numeric_limits<Id>::max();
};

/// Combines join and split trees of the same nodes, numbered as they come in the order, given by the parents in each
/// (Carr, Snoeyink and Axen 2003). O(n).
ContourArcs contour_arcs(const std::array<std::vector<Id>, 2>& parents);

}  // namespace gale::detail
