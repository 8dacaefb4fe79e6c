#pragma once

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/morse_smale/critical_places.hpp>
#include <gale/algorithms/separatrices.hpp>

namespace gale::detail {

/// The descending walls of critical triangles, and what follows from them.
struct DescendingSurfaces {
  Separatrices<TriangleVertices> walls;  ///< their triangles, the critical one first

  /// Saddle connectors: from a critical edge (source) to a critical triangle (destination) in whose wall it is, the
  /// triangles on the way, the last one included.
  Separatrices<TriangleVertices> connectors;
};

/// Finds them on `threads` threads. Walls are in the order of critical triangles, and so are connectors; those of one
/// triangle in the order of critical edges.
DescendingSurfaces descending_surfaces(const DiscreteGradient& gradient, const CriticalPlaces& places, bool want_walls,
                                       bool want_connectors, int threads);

}  // namespace gale::detail
