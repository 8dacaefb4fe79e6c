#pragma once

#include <functional>
#include <vector>

#include <gale/algorithms/merge_tree/merge_forest.hpp>
#include <gale/algorithms/simplify_field/changing_order.hpp>

namespace gale::detail {

/// Says which extrema of a forest stay, by place.
using ChooseExtrema = std::function<std::vector<bool>(Side side, const MergeForest& forest)>;

/// What there is to remove on one side of an order.
struct RemovedBranches {
  Id extrema = 0;                      ///< how many there are
  Id unwanted = 0;                     ///< how many of them don't stay
  std::vector<FilledBranch> branches;  ///< of those that don't, as far as none lies within another one
};

/// The branches of the extrema that don't stay: the parts of what is below (above) a saddle that have none that stays.
/// Each component of the mesh keeps its oldest one at least. What is in the room is overwritten.
template <class Space>
RemovedBranches removed_branches(ChangingOrder<Space>& order, Side side, const ChooseExtrema& staying,
                                 const ChangingRoom<MemoryOf<Space>>& room);

}  // namespace gale::detail
