#pragma once

#include <array>
#include <vector>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/morse_smale/critical_places.hpp>
#include <gale/algorithms/persistence.hpp>
#include <gale/algorithms/persistence/filtration.hpp>

namespace gale::detail {

/// For each saddle the places of the two extrema that its paths end at; no_id for the outside of the mesh.
using PathEnds = std::vector<std::array<Id, 2>>;

/// The minima that the paths from the two vertices of each critical edge fall to.
PathEnds ends_of_edges(const DiscreteGradient& gradient, const CriticalPlaces& places);

/// The maxima that the paths from the tetrahedra of each critical triangle rise to. A triangle of one tetrahedron has
/// the outside on its other side; one of three or more has it on both. Paths don't fork here.
PathEnds ends_of_triangles(const DiscreteGradient& gradient, const CriticalPlaces& places);

/// The ends of all saddles' paths.
struct ExtremumEnds {
  PathEnds of_edges, of_triangles;
};

/// Whether a rising path forks: at a triangle of three tetrahedra or more.
bool forks(const DiscreteGradient& gradient);

/// Pairs saddles with the extrema between which they are: goes through the saddles in the order of `saddles`, and joins
/// the sets of its two ends. Of these two the one whose oldest extremum is younger ends there: that extremum is paired
/// with the saddle. `age[extremum]` counts from 0, the oldest; the outside (no_id) is older than all. Returns for each
/// extremum the saddle that it is paired with, no_id if it is with none. Sequential, nearly O(n).
std::vector<Id> join_ends(const std::vector<Id>& saddles, const PathEnds& ends, const std::vector<Id>& age);

/// For each maximum the 2-saddle that it is paired with, no_id if it is with none, whatever rising paths do: where they
/// fork, a 2-saddle has more ends than two, and sets of extrema can't tell. By elimination over Z2. For meshes with
/// triangles of three tetrahedra and more, which are no part of space: sequential, and up to cubic.
std::vector<Id> pair_forked_maxima(const DiscreteGradient& gradient, const CriticalPlaces& places,
                                   const Filtration& filtration);

/// As `find_persistence_pairs`, but with rising paths that don't fork: at a triangle of three tetrahedra or more they
/// take the way that `tetrahedron_successor` has, and such a triangle is paired with no maximum. So each pair with a
/// maximum can be cancelled. The same where no triangle has three. `ends` are those of the gradient's paths.
PersistencePairs pairs_along_successors(const DiscreteGradient& gradient, const CriticalPlaces& places,
                                        const ExtremumEnds& ends, int threads);

}  // namespace gale::detail
