#pragma once

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/morse_smale/critical_places.hpp>
#include <gale/algorithms/separatrices.hpp>

namespace gale::detail {

/// From each critical edge, from both its vertices, that of lower input id first, down to a minimum: the vertices on
/// the way.
Separatrices<Id> descending_separatrices(const DiscreteGradient& gradient, const CriticalPlaces& places);

/// From each critical triangle, from each of its tetrahedra by input id, up to a maximum: the tetrahedra on the way.
/// Those that leave through the mesh's surface are left out.
Separatrices<Id> ascending_separatrices(const DiscreteGradient& gradient, const CriticalPlaces& places);

}  // namespace gale::detail
