#pragma once

#include <array>
#include <vector>

#include <gale/algorithms/merge_tree.hpp>

namespace gale::app {

/// A tree as it is drawn: upright branches in columns side by side, each joined to the one that it hangs on.
struct PlanarTree {
  using Place = std::array<double, 2>;  ///< from 0 to 1 from left to right, and a height

  struct Node {
    Id node;  ///< of the tree
    Place place;
  };

  std::vector<Node> nodes;               ///< ends of branches, each once
  std::vector<std::vector<Place>> arcs;  ///< the way of each
  std::vector<Id> arc_of;  ///< of each of the tree's arcs the one here that it is a part of, or hangs on; no_id
  Id branches = 0;         ///< how many the tree has
  Id shown = 0;            ///< how many of these are here
};

/// Takes a tree apart into branches (Pascucci et al. 2004), from the least persistent leaf to the longest way through
/// each component, and shows the last `most` of these. What is left out hangs on what is shown. `heights` are those of
/// the nodes, finite and in their order. Branches to maxima stand on the right of what they hang on, those to minima on
/// the left; where all are of one kind, on both sides. O(n log n) for n nodes of few arcs each.
PlanarTree planar_tree(const MergeTree& tree, const std::vector<double>& heights, Id most);

}  // namespace gale::app
