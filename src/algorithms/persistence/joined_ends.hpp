#pragma once

#include <vector>

#include <gale/algorithms/persistence/path_ends.hpp>

namespace gale::detail {

/// Pairs saddles with the extrema between which they are: goes through the saddles in the order of `saddles`, and joins
/// the sets of its two ends. Of these two the one whose oldest extremum is younger ends there: that extremum is paired
/// with the saddle. `age[extremum]` counts from 0, the oldest; the outside (no_id) is older than all. Returns for each
/// extremum the saddle that it is paired with, no_id if it is with none. Sequential, nearly O(n).
std::vector<Id> join_ends(const std::vector<Id>& saddles, const PathEnds& ends, const std::vector<Id>& age);

}  // namespace gale::detail
