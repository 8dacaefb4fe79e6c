#pragma once

#include <optional>

#include <vtkSmartPointer.h>

#include <gale/io/dataset.hpp>
#include <gale/mesh/mesh.hpp>

class vtkUnstructuredGrid;
class vtkDataArray;
class vtkDataSet;
class vtkPointSet;

namespace gale::vtk {

/// The grid's points: where they are if they are float or double and lie point by point, else a copy in double.
io::Dataset::Positions positions_of(vtkUnstructuredGrid* grid);

/// The mesh of the grid's cells (`split_cells`, `split_polygons`), which are read where they are unless there are
/// polyhedra. Throws gale::Error as make_mesh does.
Mesh mesh_of(vtkUnstructuredGrid* grid, const io::Dataset::Positions& points, int capacity);

/// The cells of another data set, such as a structured grid or a surface, that are visible, with its points and arrays.
vtkSmartPointer<vtkUnstructuredGrid> unstructured(vtkPointSet* cells);

/// Voxels as a mesh.
struct Voxels {
  Grid grid;                                     ///< what its cells are
  vtkSmartPointer<vtkUnstructuredGrid> without;  ///< its points, with their arrays; no cells
};

/// The mesh of the voxels of an image or a rectilinear grid whose values are above `above`, or are finite without it
/// (`io::split_voxels`), with all point arrays of numbers. `field` is the array that `above` is about; one without a
/// name is called "field". Throws gale::Error for no field, for axes that aren't as long as their dimensions, and as
/// io::split_voxels does. Precondition: each array has a row for each point.
Voxels voxels_of(vtkDataSet* voxels, vtkDataArray* field, std::optional<double> above);

/// Gives a mesh the tetrahedra, or triangles, of a grid.
void write_cells(const Grid& grid, vtkUnstructuredGrid* mesh);

}  // namespace gale::vtk
