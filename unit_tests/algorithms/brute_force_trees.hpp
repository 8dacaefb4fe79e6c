#pragma once

#include <vector>

#include <gale/algorithms/merge_tree.hpp>

#include "support/brute_force.hpp"

namespace gale::test {

/// A tree by going through all vertices, one after the other, joining each with its neighbours; and contour trees with
/// all vertices as nodes, pruned leaf by leaf, of which the regular ones are taken out in the end.
MergeTree brute_force_tree(Tree tree, const BruteForce::Table& neighbours, const std::vector<double>& values);

/// The vertices that are lower (higher) than all their neighbours, ascending.
std::vector<Id> brute_force_extrema(bool maxima, const BruteForce::Table& neighbours,
                                    const std::vector<double>& values);

/// The minima (maxima) of an order whose branches of the join (split) tree are at least so persistent by their values,
/// or don't end; ascending.
std::vector<Id> brute_force_persistent(bool maxima, const BruteForce::Table& neighbours,
                                       const std::vector<double>& order, const std::vector<double>& values,
                                       double threshold);

}  // namespace gale::test
