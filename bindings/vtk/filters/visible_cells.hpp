#pragma once

#include <vector>

#include <vtkSmartPointer.h>

class vtkDataSet;
class vtkIdList;
class vtkPointSet;
class vtkUnstructuredGrid;

// Cells that VTK's filters show, as the arrays vtkGhostType say.

namespace gale::vtk {

/// Which cells are no part of a mesh: hidden ones, refined ones, copies of another piece's, and those with a hidden
/// point. Empty where neither cells nor points are so. Throws gale::Error for a cell of a point that there is not.
std::vector<bool> invisible_cells(vtkDataSet* mesh);

/// The mesh without these cells, and without the points that no other cell has. Points and cells keep their order.
/// Throws gale::Error for a cell of a point that there is not.
vtkSmartPointer<vtkUnstructuredGrid> without(const std::vector<bool>& cells, vtkUnstructuredGrid* mesh);

/// The visible cells of a grid or a surface with their points and arrays. The grid itself if it is unstructured and all
/// of it is visible.
vtkSmartPointer<vtkUnstructuredGrid> visible_cells(vtkPointSet* mesh);

/// What VTK has of a cell: its points, or of a polyhedron the number of its faces, and of each the number of its points
/// and these.
void get_entries(vtkUnstructuredGrid* grid, vtkIdType cell, vtkIdList* entries);

}  // namespace gale::vtk
