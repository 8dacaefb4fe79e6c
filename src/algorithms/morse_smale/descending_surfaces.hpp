#pragma once

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/morse_smale/critical_places.hpp>
#include <gale/algorithms/persistence/turned_gradient.hpp>
#include <gale/algorithms/separatrices.hpp>

namespace gale::detail {

/// The descending walls of critical triangles, and what follows from them.
struct DescendingSurfaces {
  Separatrices<TriangleVertices> walls;  ///< their triangles, the critical one first

  /// Saddle connectors: from a critical edge (source) to a critical triangle (destination) in whose wall it is, the
  /// triangles on the way, the last one included.
  Separatrices<TriangleVertices> connectors;
};

/// Finds those of `critical` on `threads` threads. With `turned` in the gradient that these edges make of it, and no
/// connector of which the critical edge is higher than the triangle. Walls are in the order of critical triangles, and
/// so are connectors; those of one triangle in the order of critical edges. `told` says how connectors are.
DescendingSurfaces descending_surfaces(const DiscreteGradient& gradient, const CriticalSimplices& critical,
                                       const CriticalPlaces& places, bool want_walls, bool want_connectors, int threads,
                                       const TurnedEdges* turned = nullptr, Paths told = Paths::whole);

}  // namespace gale::detail
