#pragma once

#include <optional>

#include <vtkSmartPointer.h>

#include <gale/io/dataset.hpp>
#include <gale/mesh/mesh.hpp>

class vtkUnstructuredGrid;
class vtkDataArray;
class vtkDataSet;

namespace gale::vtk {

/// The grid's points: where they are if they are float or double and lie point by point, else a copy in double.
io::Dataset::Positions positions_of(vtkUnstructuredGrid* grid);

/// The mesh of the grid's cells (`split_cells`, `split_polygons`), which are read where they are unless there are
/// polyhedra. Throws gale::Error where no cell has two or three dimensions, and as make_mesh does. Precondition: there
/// are cells.
Mesh mesh_of(vtkUnstructuredGrid* grid, const io::Dataset::Positions& points, int capacity);

/// Voxels as a mesh.
struct Voxels {
  std::optional<Grid> grid;                   ///< what its cells are; none where invisible ones are left out
  vtkSmartPointer<vtkUnstructuredGrid> mesh;  ///< its points, with their arrays; cells only where there is no grid
};

/// The mesh of the voxels of an image or a rectilinear grid whose values are above `above`, or are finite without it
/// (`io::split_voxels`), but for `invisible_cells`, with all point arrays of numbers: `field` first, which `above` is
/// about. Throws gale::Error for no field, for axes that aren't as long as their dimensions, and as io::split_voxels
/// does. Precondition: each array has a row for each point, and the field a name.
Voxels voxels_of(vtkDataSet* voxels, vtkDataArray* field, std::optional<double> above);

/// Gives a mesh the tetrahedra, or triangles, of a grid.
void write_cells(const Grid& grid, vtkUnstructuredGrid* mesh);

}  // namespace gale::vtk
