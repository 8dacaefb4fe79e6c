#pragma once

#include <gale/algorithms/morse_smale.hpp>
#include <gale/export.hpp>
#include <gale/outputs/critical_simplices.hpp>

namespace gale::outputs {

/// The 2-separatrices as polygons: first the descending walls, whose polygons are the triangles that each critical
/// triangle's falling paths sweep; then the ascending walls, which have a polygon for each edge that a critical edge's
/// rising paths cross, through the barycentres of the tetrahedra around it. Edges with fewer than three tetrahedra have
/// none. Walls come in the order of the complex and are numbered through.
///
/// Points are shared by all polygons: first vertices, then barycentres, each by ascending input id of the vertex or the
/// tetrahedron. Arrays of polygons: SourceId, SeparatrixId (int32), SeparatrixType (int8: 1 ascending, 2 descending),
/// SeparatrixFunctionMaximum, Minimum and Difference (float if the field is, else double),
/// NumberOfCriticalPointsOnBoundary (int32: of the source and the critical simplices that bound the wall, how many have
/// their highest vertex on the mesh's surface). A descending wall reaches from its source's highest vertex down to the
/// lowest vertex of the critical edges that bound it, or of itself where none does; an ascending one from its source's
/// lowest vertex up, likewise.
///
/// `field` is that of the complex and `critical` its critical simplices. `connectors` say which critical simplices
/// bound a wall: all that the complex has, of which only the ends are read. Throws gale::Error if there are more than
/// 2^31 - 1 points or polygons.
///
/// On one rank's part of a mesh these are the walls of its own critical simplices, with the numbers that they have
/// among those of all ranks; ids are int64. Collective then.
GALE_EXPORT io::Surface separatrices2(const io::Dataset& dataset, const io::PointArray& field,
                                      const MorseSmaleComplex& complex,
                                      const Separatrices<TriangleVertices>& connectors, const KnownSimplices& critical);

}  // namespace gale::outputs
