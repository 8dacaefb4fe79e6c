#pragma once

#include <gale/algorithms/discrete_gradient.hpp>

namespace gale::detail {

using HostIds = Array<Id, HostMemory>;

/// For each vertex, by input id: the place among the critical vertices of the minimum that its path falls to.
HostIds descending_manifolds(const DiscreteGradient& gradient);

/// For each vertex, by input id: the place among the critical tetrahedra of the maximum that the path from its
/// tetrahedron of lowest input id rises to; no_id if it leaves through the surface, or the vertex has no tetrahedron.
HostIds ascending_manifolds(const DiscreteGradient& gradient);

/// A number for each pair (ascending, descending) that occurs, in lexicographic order, dense from 0; no_id where the
/// ascending one is missing. And how many pairs there are.
std::pair<HostIds, Id> morse_smale_manifolds(const HostIds& ascending, const HostIds& descending);

}  // namespace gale::detail
