#pragma once

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/simplex_numbers.hpp>
#include <gale/io/write.hpp>

namespace gale::outputs {

/// A critical simplex as users know it.
struct CriticalSimplex {
  Id cell;                     ///< its CellId
  std::array<Id, 4> vertices;  ///< input ids, from the highest to the lowest
  std::int8_t dimension;       ///< has one vertex more
  std::int8_t on_surface;      ///< its highest vertex

  Id highest() const { return vertices[0]; }
  Id lowest() const { return vertices[dimension]; }
};

/// The critical simplices of each dimension, by ascending CellId: as in `critical`.
using KnownSimplices = std::array<std::vector<CriticalSimplex>, 4>;

/// `critical` are some of the gradient's; `numbers` begin with those of its edges and triangles.
KnownSimplices known_simplices(const DiscreteGradient& gradient, const CriticalSimplices& critical,
                               const SimplexNumbers& numbers);

/// All of them as points: dimension by dimension. Their positions are vertices, the middles of edges, the incentres of
/// triangles and the barycentres of tetrahedra. Each has the input's point arrays at its highest vertex, then
/// CellDimension, CellId, IsOnBoundary and ttkVertexScalarField.
io::PointSet to_point_set(const io::Dataset& dataset, const KnownSimplices& simplices);

}  // namespace gale::outputs
