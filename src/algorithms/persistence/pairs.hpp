#pragma once

#include <gale/algorithms/persistence.hpp>

namespace gale::detail {

/// As `find_persistence_pairs`, but with rising paths that don't fork: at a triangle of three tetrahedra or more they
/// take the way that `tetrahedron_successor` has, and such a triangle is paired with no maximum. So each pair with a
/// maximum can be cancelled. The same where no triangle has three.
PersistencePairs pairs_along_successors(const DiscreteGradient& gradient, const SweepOptions& options);

}  // namespace gale::detail
