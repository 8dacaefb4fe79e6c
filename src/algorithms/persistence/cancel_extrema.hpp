#pragma once

#include <vector>

#include <gale/algorithms/persistence.hpp>
#include <gale/algorithms/persistence/path_ends.hpp>
#include <gale/algorithms/persistence/turned_forest.hpp>

namespace gale::detail {

/// Cancels the extrema of these pairs with their saddles, and turns the paths between them around in `forest`. `ends`
/// and `sides` say for each saddle which extrema its paths end at, and where they begin; no_id stands for the outside.
/// The pairs are such that those that are joined by saddles have one extremum among them that stays, or the outside:
/// returns for each extremum the one that its manifold becomes part of; no_id if it is the outside.
std::vector<Id> cancel_extrema(const std::vector<PersistencePair>& pairs, Id PersistencePair::*extremum,
                               Id PersistencePair::*saddle, const PathEnds& ends,
                               const std::vector<std::array<Id, 2>>& sides, std::size_t extrema, TurnedForest& forest);

/// The vertices of each critical edge, and the tetrahedra of each critical triangle; no_id for what is outside.
std::vector<std::array<Id, 2>> sides_of_edges(const CriticalSimplices& critical);
std::vector<std::array<Id, 2>> sides_of_triangles(const CriticalSimplices& critical);

}  // namespace gale::detail
