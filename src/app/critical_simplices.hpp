#pragma once

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/simplex_numbers.hpp>
#include <gale/io/write.hpp>

namespace gale::app {

/// The critical simplices of a gradient as users know them: dimension by dimension, each by ascending CellId. Their positions are vertices, the middles of edges, the incentres
/// of triangles and the barycentres of tetrahedra. Each has the input's point arrays at its highest vertex, then CellDimension, CellId, IsOnBoundary and
/// ttkVertexScalarField. `numbers` are those of the critical edges and triangles.
io::PointSet to_point_set(const io::Dataset& dataset, const DiscreteGradient& gradient, const SimplexNumbers& numbers);

}  // namespace gale::app
