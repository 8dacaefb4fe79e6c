#pragma once

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/morse_smale/critical_places.hpp>
#include <gale/algorithms/separatrices.hpp>

namespace gale::detail {

/// What the descending walls of the critical triangles tell.
struct DescendingSurfaces {
  Separatrices<TriangleVertices> walls;  ///< their triangles; from the critical triangle

  /// Saddle connectors: from a critical edge (source) to a critical triangle (destination) in whose wall it is, the
  /// triangles on the way, the last one included.
  Separatrices<TriangleVertices> connectors;
};

/// By critical triangle, and connectors then by critical edge. On `threads` threads.
DescendingSurfaces descending_surfaces(const DiscreteGradient& gradient, const CriticalPlaces& places, bool want_walls,
                                       bool want_connectors, int threads);

}  // namespace gale::detail
