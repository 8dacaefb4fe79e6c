#pragma once

#include <gale/algorithms/morse_smale.hpp>
#include <gale/export.hpp>
#include <gale/outputs/critical_simplices.hpp>
#include <gale/outputs/named_simplices.hpp>

namespace gale::outputs {

/// The 1-separatrices, a line each: along it, simplices of two dimensions in turn. Lines of one kind that pass the same
/// simplex have its point in common.
///
/// - Descending ones: from a critical edge, over vertices and edges, to a minimum.
/// - Ascending ones: from a critical triangle, over tetrahedra and triangles, to a maximum; on a triangle mesh from a
///   critical edge, over triangles and edges.
/// - Connectors: from a critical edge, over triangles and edges, to a critical triangle.
///
/// A joined one (`Separatrices::joins`) ends at a point inside an earlier one, which has the same DestinationId.
///
/// All come in that order, each kind in the order of the complex, and are numbered through. Points are placed as by
/// `to_point_set`. Point arrays: ttkMaskScalarField (int8, 0 at both ends), CellDimension (int8), CellId (int32).
/// Arrays of lines: SourceId, DestinationId, SeparatrixId (int32), SeparatrixType (int8: 0 descending, 1 connector, 2
/// ascending; on a triangle mesh 1 ascending), SeparatrixFunctionMaximum, Minimum and Difference (the highest and the
/// lowest value at the vertices of both ends; float if the field is, else double), NumberOfCriticalPointsOnBoundary
/// (int32: how many of the two ends have their highest vertex on the mesh's surface).
///
/// `field` is that of the complex, `numbers` are those of `named`, the complex's `named_simplices`, and `critical` its
/// critical simplices. In parallel. Throws gale::Error if there are more than 2^31 - 1 points.
///
/// On one rank's part of a mesh these are the separatrices that begin at critical simplices of its own, with the
/// numbers that they have among those of all ranks; ids are int64. Collective then.
GALE_EXPORT io::Surface separatrices1(const io::Dataset& dataset, const io::PointArray& field,
                                      const MorseSmaleComplex& complex, const NamedPaths& named,
                                      const SimplexNumbers& numbers, const KnownSimplices& critical);

}  // namespace gale::outputs
