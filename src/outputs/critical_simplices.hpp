#pragma once

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/simplex_numbers.hpp>
#include <gale/export.hpp>
#include <gale/io/write.hpp>

namespace gale::outputs {

/// A critical simplex as users know it.
struct CriticalSimplex {
  GlobalId cell;               ///< its CellId: the global id of a vertex or cell, else as in `SimplexNumbers`
  std::array<Id, 4> vertices;  ///< input ids, from the highest to the lowest; the first dimension + 1 count
  std::int8_t dimension;       ///< 0 to that of the mesh
  std::int8_t on_surface;      ///< 1 if its highest vertex is on the mesh's surface, else 0

  /// The input id of its highest vertex.
  Id highest() const { return vertices[0]; }

  /// The input id of its lowest vertex.
  Id lowest() const { return vertices[dimension]; }
};

/// The critical simplices of each dimension, each in the order of the `CriticalSimplices` that they are made from: by
/// ascending CellId.
using KnownSimplices = std::array<std::vector<CriticalSimplex>, 4>;

/// Names critical simplices as users know them. `critical` is what the gradient left unpaired, or what `simplify` left
/// of that. `numbers` begin with those of `critical.edges` and `critical.triangles`, in their order; more may follow
/// (`named_simplices`).
GALE_EXPORT KnownSimplices known_simplices(const DiscreteGradient& gradient, const CriticalSimplices& critical,
                                           const SimplexNumbers& numbers);

/// Leaves out the critical simplices of a complex that aren't this rank's.
GALE_EXPORT KnownSimplices own_simplices(const MorseSmaleComplex& complex, const KnownSimplices& all);

/// Makes points of critical simplices, dimension by dimension. They are at vertices, the middles of edges, the
/// incentres of triangles and the barycentres of tetrahedra, rounded to the type of the input's coordinates. Each has
/// the input's point arrays at its highest vertex, then CellDimension (int8), CellId (int32), IsOnBoundary (int8) and
/// ttkVertexScalarField (int32, the input id of its highest vertex). Of one rank's part of a mesh, whose `exchange` it
/// is, ids are global ones and int64. Throws gale::Error for a vertex that an array of the dataset has no value for.
GALE_EXPORT io::PointSet to_point_set(const io::Dataset& dataset, const KnownSimplices& simplices,
                                      const Exchange& exchange = Exchange::of_whole_mesh());

}  // namespace gale::outputs
