#pragma once

#include <gale/io/dataset.hpp>
#include <gale/mesh/mesh.hpp>

class vtkUnstructuredGrid;

namespace gale::vtk {

/// The grid's points: where they are if they are float or double and lie point by point, else a copy in double.
io::Dataset::Positions positions_of(vtkUnstructuredGrid* grid);

/// The mesh of the grid's tetrahedra, which are read where they are if there are no other cells. Cells of lower
/// dimension are left out. Throws gale::Error for other cells of dimension 3, and as make_mesh.
Mesh mesh_of(vtkUnstructuredGrid* grid, const io::Dataset::Positions& points, int capacity);

}  // namespace gale::vtk
