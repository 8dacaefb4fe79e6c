#pragma once

#include <gale/algorithms/morse_smale.hpp>
#include <gale/outputs/critical_simplices.hpp>
#include <gale/outputs/heights.hpp>

namespace gale::outputs {

/// The 2-separatrices as polygons, in the arrays that TTK has: the triangles of each critical triangle's descending
/// wall; then, for each edge of a critical edge's ascending wall that has three or more tetrahedra, the polygon through
/// their barycentres. Points are shared within each kind, and by ascending input id of the vertex or tetrahedron.
/// `connectors` are all that there are, of which the ends are read: they say which critical simplices bound a wall.
/// Throws gale::Error if there are more than 2^31 - 1 polygons.
io::Surface separatrices2(const io::Dataset& dataset, const MorseSmaleComplex& complex,
                          const Separatrices<TriangleVertices>& connectors, const KnownSimplices& critical,
                          const Heights& heights);

}  // namespace gale::outputs
