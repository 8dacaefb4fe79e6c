#pragma once

#include <vector>

#include <gale/algorithms/morse_smale/critical_places.hpp>
#include <gale/algorithms/persistence/filtration.hpp>

namespace gale::detail {

/// For each maximum the 2-saddle that it is paired with, no_id if it is with none, whatever rising paths do: where they
/// fork, a 2-saddle has more ends than two, and sets of extrema can't tell. By elimination over Z2. For meshes with
/// triangles of three tetrahedra and more, which are no part of space: sequential, and up to cubic.
std::vector<Id> pair_forked_maxima(const DiscreteGradient& gradient, const CriticalPlaces& places,
                                   const Filtration& filtration);

}  // namespace gale::detail
