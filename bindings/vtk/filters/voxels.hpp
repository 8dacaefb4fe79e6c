#pragma once

#include <optional>

#include <vtkSmartPointer.h>

class vtkDataArray;
class vtkDataSet;
class vtkUnstructuredGrid;

namespace gale::vtk {

/// The tetrahedra of the voxels of an image or a rectilinear grid whose values are above `above`, or are finite without
/// it (`io::split_voxels`), with all point arrays of numbers. `field` is the array that `above` is about; one without a
/// name is called "field". Throws gale::Error for no field, for axes that aren't as long as their dimensions, and as
/// io::split_voxels does. Precondition: each array has a row for each point.
vtkSmartPointer<vtkUnstructuredGrid> split_voxels(vtkDataSet* voxels, vtkDataArray* field, std::optional<double> above);

}  // namespace gale::vtk
