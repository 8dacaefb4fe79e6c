#pragma once

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/morse_smale/critical_places.hpp>
#include <gale/algorithms/separatrices.hpp>

namespace gale::detail {

/// The paths from each critical edge down to minima, one from each of its vertices, that of lower input id first: the
/// vertices on the way, along these successors, where these are.
Separatrices<Id> descending_separatrices(const Mesh& mesh, const Mirrored<Id>& successors,
                                         const CriticalSimplices& critical, const CriticalPlaces& places,
                                         Paths told = Paths::whole);

/// The paths from each critical triangle up to maxima, one from each of its tetrahedra, by input id: the tetrahedra on
/// the way, along these successors. Those that leave through the mesh's surface are left out.
Separatrices<Id> ascending_separatrices(const Mirrored<Id>& successors, const CriticalSimplices& critical,
                                        const CriticalPlaces& places, Paths told = Paths::whole);

}  // namespace gale::detail
