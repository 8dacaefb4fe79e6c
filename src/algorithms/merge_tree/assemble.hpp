#pragma once

#include <array>
#include <limits>
#include <utility>
#include <vector>

#include <gale/algorithms/merge_tree.hpp>
#include <gale/algorithms/merge_tree/side_keys.hpp>

namespace gale::detail {

/// The arcs of contour trees, in the order in which they are pruned from leaves.
struct ContourArcs {
  std::vector<std::pair<Id, Id>> ends;  ///< the lower node and the upper one

  /// By side, of the arc from each node to its parent: the number of the contour arc whose pruning took it away. A
  /// vertex lies on the one of the lowest number that took away its arc of either side.
  std::array<std::vector<Id>, 2> taken_by;

  /// The arc of such a number: those beyond all arcs are arcs over again, for vertices that no other one has.
  Id arc_of(Id number) const {
    const auto count = static_cast<Id>(ends.size());
    return number < count ? number : number - count;
  }

  static constexpr Id nobody = std::numeric_limits<Id>::max();
};

/// Combines join and split trees of the same nodes, numbered as they come in the order, given by the parents in each
/// (Carr, Snoeyink and Axen 2003). In a mesh with holes a node may be left that is a leaf of both: it hangs on its
/// parent in the split tree, or where there is none, in the join tree; so there is one tree for each component. O(n).
ContourArcs contour_arcs(const std::array<std::vector<Id>, 2>& parents);

/// A tree without the arcs of vertices, of nodes (input vertices, as they come in the order) and of arcs between them,
/// a lower and an upper one each. `place` is told where each of the arcs has gone.
MergeTree tree_of(std::vector<Id> nodes, const std::vector<std::pair<Id, Id>>& ends, std::vector<Id>& place);

/// Sets the arcs of a tree's nodes, which are any before, and takes them from those that they were counted on.
void set_arcs_of_nodes(MergeTree& tree);

}  // namespace gale::detail
