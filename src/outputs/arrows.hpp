#pragma once

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/io/write.hpp>

namespace gale::outputs {

/// The pairs of a gradient, ready for glyphs: at the barycentre of each pair's lower simplex (the tail) the Vector to
/// the barycentre of the other (the head), and the CellDimension of the tail. First those of vertices, by input id;
/// then of edges, by the input ids of their higher and their lower vertex; then of triangles, by the input id of the
/// tetrahedron. In parallel. Throws gale::Error if there are more than 2^31 - 1.
io::PointSet arrows_of(const io::Dataset& dataset, const DiscreteGradient& gradient);

}  // namespace gale::outputs
