#include <algorithm>
#include <iterator>

#include <gale/mesh/cells/cell_types.hpp>

namespace gale {
namespace {

constexpr CellType all_types[] = {{0, "vtkEmptyCell", 0, 0},
                                  {1, "vtkVertex", 0, 1},
                                  {2, "vtkPolyVertex", 0, 0},
                                  {3, "vtkLine", 1, 2},
                                  {4, "vtkPolyLine", 1, 0},
                                  {5, "vtkTriangle", 2, 3, "triangles"},
                                  {6, "vtkTriangleStrip", 2, 0, "triangle strips"},
                                  {7, "vtkPolygon", 2, 0, "polygons"},
                                  {8, "vtkPixel", 2, 4, "pixels"},
                                  {9, "vtkQuad", 2, 4, "quads"},
                                  {10, "vtkTetra", 3, 4, "tetrahedra"},
                                  {11, "vtkVoxel", 3, 8, "voxels"},
                                  {12, "vtkHexahedron", 3, 8, "hexahedra"},
                                  {13, "vtkWedge", 3, 6, "wedges"},
                                  {14, "vtkPyramid", 3, 5, "pyramids"},
                                  {15, "vtkPentagonalPrism", 3, 10, "pentagonal prisms"},
                                  {16, "vtkHexagonalPrism", 3, 12, "hexagonal prisms"},
                                  {21, "vtkQuadraticEdge", 1, 3},
                                  {22, "vtkQuadraticTriangle", 2, 6, "quadratic triangles"},
                                  {23, "vtkQuadraticQuad", 2, 8},
                                  {24, "vtkQuadraticTetra", 3, 10, "quadratic tetrahedra"},
                                  {25, "vtkQuadraticHexahedron", 3, 20},
                                  {26, "vtkQuadraticWedge", 3, 15},
                                  {27, "vtkQuadraticPyramid", 3, 13},
                                  {28, "vtkBiQuadraticQuad", 2, 9},
                                  {29, "vtkTriQuadraticHexahedron", 3, 27},
                                  {30, "vtkQuadraticLinearQuad", 2, 6},
                                  {31, "vtkQuadraticLinearWedge", 3, 12},
                                  {32, "vtkBiQuadraticQuadraticWedge", 3, 18},
                                  {33, "vtkBiQuadraticQuadraticHexahedron", 3, 24},
                                  {34, "vtkBiQuadraticTriangle", 2, 7},
                                  {35, "vtkCubicLine", 1, 4},
                                  {36, "vtkQuadraticPolygon", 2, 0},
                                  {37, "vtkTriQuadraticPyramid", 3, 19},
                                  {41, "vtkConvexPointSet", 3, 0},
                                  {42, "vtkPolyhedron", 3, 0, "polyhedra"},
                                  {68, "vtkLagrangeCurve", 1, 0},
                                  {69, "vtkLagrangeTriangle", 2, 0},
                                  {70, "vtkLagrangeQuadrilateral", 2, 0},
                                  {71, "vtkLagrangeTetra", 3, 0},
                                  {72, "vtkLagrangeHexahedron", 3, 0},
                                  {73, "vtkLagrangeWedge", 3, 0},
                                  {74, "vtkLagrangePyramid", 3, 0},
                                  {75, "vtkBezierCurve", 1, 0},
                                  {76, "vtkBezierTriangle", 2, 0},
                                  {77, "vtkBezierQuadrilateral", 2, 0},
                                  {78, "vtkBezierTetra", 3, 0},
                                  {79, "vtkBezierHexahedron", 3, 0},
                                  {80, "vtkBezierWedge", 3, 0},
                                  {81, "vtkBezierPyramid", 3, 0}};

}  // namespace

const CellType* find_cell_type(int number) {
  const auto* const found = std::find_if(std::begin(all_types), std::end(all_types),
                                         [number](const CellType& type) { return type.number == number; });
  return found == std::end(all_types) ? nullptr : found;
}

}  // namespace gale
