#pragma once

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/morse_smale/critical_places.hpp>
#include <gale/algorithms/separatrices.hpp>

namespace gale::detail {

/// The saddle connectors of a gradient that kernels found, by kernels where it is: those that `descending_surfaces`
/// finds, in its order. Walls are made together that have `most_together` triangles at most, a single one with any
/// number: 2^26 take 4 GiB, beside the connectors. Throws OutOfMemory if one doesn't fit there.
Separatrices<TriangleVertices> device_connectors(const DiscreteGradient& gradient, const CriticalSimplices& critical,
                                                 const CriticalPlaces& places, Offset most_together = Offset(1) << 26);

}  // namespace gale::detail
