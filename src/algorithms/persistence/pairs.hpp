#pragma once

#include <gale/algorithms/persistence.hpp>
#include <gale/algorithms/persistence/path_ends.hpp>

namespace gale::detail {

/// As `find_persistence_pairs`, but with rising paths that don't fork: at a triangle of three tetrahedra or more they
/// take the way that `tetrahedron_successor` has, and such a triangle is paired with no maximum. So each pair with a
/// maximum can be cancelled. The same where no triangle has three. `ends` are those of the gradient's paths.
PersistencePairs pairs_along_successors(const DiscreteGradient& gradient, const CriticalPlaces& places,
                                        const ExtremumEnds& ends, int threads);

}  // namespace gale::detail
