#pragma once

#include <gale/algorithms/critical_points.hpp>
#include <gale/export.hpp>
#include <gale/io/write.hpp>

namespace gale::outputs {

/// The critical points of a piecewise linear field as points where their vertices are, in their order (by ascending
/// input id). Each has the input's point arrays at its vertex, then CriticalType (int8, the codes of `CriticalType`),
/// IsOnBoundary (int8, 1 for a vertex on the mesh's surface) and ttkVertexScalarField (int32, the input id; of one
/// rank's part of a mesh, whose `exchange` it is, int64, the global id).
///
/// `dataset` is what `points` were found on; its tetrahedra are not read. Throws gale::Error for a vertex that an array
/// of the dataset has no value for.
GALE_EXPORT io::PointSet to_point_set(const io::Dataset& dataset, const CriticalPoints& points,
                                      const Exchange& exchange = Exchange::of_whole_mesh());

}  // namespace gale::outputs
