#pragma once

#include <utility>
#include <vector>

#include <gale/algorithms/discrete_gradient.hpp>

// Manifolds are where they were found: in the workers' memory, if there is room. Of a mesh on several ranks they are
// on the host; finding them is collective.

namespace gale::detail {

/// For each vertex, by input id, ghosts too: the place among the critical vertices of all ranks of the minimum that its
/// path falls to.
Mirrored<Id> descending_manifolds(const DiscreteGradient& gradient);

/// For each vertex, by input id, ghosts too: the place among the critical tetrahedra of all ranks of the maximum that
/// the path from its tetrahedron of lowest input id rises to; no_id if it leaves through the surface, or the vertex has
/// no tetrahedron.
Mirrored<Id> ascending_manifolds(const DiscreteGradient& gradient);

/// A number for each pair (ascending, descending) that occurs, in lexicographic order, dense from 0; no_id where the
/// ascending one is missing. And how many pairs there are. Of all ranks that the mesh lies on.
std::pair<Mirrored<Id>, Id> morse_smale_manifolds(const Mesh& mesh, const Mirrored<Id>& ascending,
                                                  const Mirrored<Id>& descending);

/// The manifolds with names[p] for each place p; no_id stays.
Mirrored<Id> renamed(const Mirrored<Id>& manifolds, const std::vector<Id>& names);

}  // namespace gale::detail
