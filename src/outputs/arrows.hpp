#pragma once

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/export.hpp>
#include <gale/io/write.hpp>

namespace gale::outputs {

/// The pairs of a gradient as arrows, ready for glyphs: a point for each pair, at the barycentre of its lower simplex
/// (the tail), with the arrays CellDimension (int8, of the tail: 0, 1 or 2) and Vector (three components of the
/// coordinates' type, from the tail to the barycentre of the other simplex). First the pairs of vertices, by input id;
/// then those of edges, by the input ids of their higher and then of their lower vertex; then those of triangles, by
/// the input id of the tetrahedron (a triangle mesh has none of these). In parallel. Throws gale::Error if there are
/// more than 2^31 - 1. On one rank's part of several they are of the simplices whose highest vertices it owns.
GALE_EXPORT io::PointSet arrows_of(const io::Dataset& dataset, const DiscreteGradient& gradient);

}  // namespace gale::outputs
