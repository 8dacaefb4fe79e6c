#pragma once

#include <optional>

#include <vtkSmartPointer.h>

class vtkDataArray;
class vtkImageData;
class vtkUnstructuredGrid;

namespace gale::vtk {

/// The tetrahedra of the image's voxels whose values are above `above`, or are finite without it (`io::split_voxels`),
/// with all point arrays of numbers. `field` is the array that `above` is about; one without a name is called "field".
vtkSmartPointer<vtkUnstructuredGrid> split_image(vtkImageData* image, vtkDataArray* field, std::optional<double> above);

}  // namespace gale::vtk
