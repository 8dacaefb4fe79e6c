#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <gale/algorithms/merge_tree/followed_paths.hpp>
#include <gale/algorithms/morse_smale/jump.hpp>

namespace gale::detail {

/// Join trees, or split trees, one for each component of the mesh. Nodes are numbered as their side comes to them, so
/// that a node's parent comes after it. The arc from a node to its parent is known by the node.
struct MergeForest {
  std::vector<Id> vertices;    ///< of each node its place among what is compared
  std::vector<Id> parent;      ///< no_id at roots
  std::vector<Id> leaf;        ///< the node of each extremum, by its place
  std::vector<Id> branch_end;  ///< of each extremum's branch, by place, by the elder rule; no_id if it has none

  Id size() const { return static_cast<Id>(vertices.size()); }
};

/// Joins the extrema (as the side comes to them) where they meet (`FollowedPaths`). `lasts` are the extrema of the
/// other side, each with the place of the extremum at which its path on this side ends: the last in each component is
/// its root.
MergeForest merge_forest(Side side, const std::vector<Id>& extrema, const std::vector<Meeting>& meetings,
                         std::vector<Meeting> lasts);

/// Joins a side's extrema at which all paths end. `others` are those of the other side, by their places.
template <class Space>
MergeForest merge_forest(const Space& space, Side side, const ComparedVertices& compared,
                         const FollowedPaths<MemoryOf<Space>>& paths, const std::vector<Id>& others) {
  const std::vector<Id> ends = ends_of(space, paths.ends, compared.at(others));
  std::vector<Meeting> lasts;
  for (std::size_t i = 0; i < others.size(); ++i) lasts.push_back({others[i], ends[i]});
  return merge_forest(side, paths.extrema, paths.meetings, std::move(lasts));
}

/// A forest without some of its branches.
struct PrunedForest {
  std::vector<Id> nodes;   ///< what is still a node, ascending
  std::vector<Id> parent;  ///< for each of these the place of its parent among them; no_id at roots
  std::vector<Id> place;   ///< of each node of the forest the place of that whose arc its own arc has become a part of
};

/// Leaves out the branches of the extrema that don't stay, by place. Of each component one at least must stay.
PrunedForest pruned(const MergeForest& forest, const std::vector<bool>& stays);

/// Which extrema, by place, are at least as persistent as a threshold; those whose branches don't end are. `value(v)`
/// is the field at one of the forest's vertices.
std::vector<bool> persistent_extrema(const MergeForest& forest, const std::function<double(Id)>& value,
                                     double threshold);

/// The parents of nodes among which a forest's are, numbered as they come in the order, whatever the side. `base` is
/// for each of them the forest's node whose arc it begins or lies on.
std::vector<Id> parents_among(Side side, const MergeForest& forest, const std::vector<Id>& base);

}  // namespace gale::detail
