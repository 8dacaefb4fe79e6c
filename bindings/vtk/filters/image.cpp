#include "image.hpp"

#include <algorithm>

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkPointData.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnstructuredGrid.h>

#include <gale/base/error.hpp>
#include <gale/io/voxels.hpp>

#include "arrays.hpp"

namespace gale::vtk {

namespace {

io::Image image_of(vtkImageData* from, vtkDataArray* field) {
  io::Image image;
  int extent[6];
  from->GetExtent(extent);
  for (int d = 0; d < 3; ++d) {
    image.dimensions[d] = extent[2 * d + 1] - extent[2 * d] + 1;
    auto& row = image.index_to_physical[d];
    row[3] = from->GetOrigin()[d];
    for (int k = 0; k < 3; ++k) {
      row[k] = from->GetDirectionMatrix()->GetElement(d, k) * from->GetSpacing()[k];
      row[3] += row[k] * extent[2 * k];
    }
  }
  image.arrays.push_back(point_array(field));
  if (image.arrays[0].name.empty()) image.arrays[0].name = "field";
  vtkPointData* const arrays = from->GetPointData();
  for (int k = 0; k < arrays->GetNumberOfArrays(); ++k) {
    vtkDataArray* const array = arrays->GetArray(k);
    if (array != nullptr && array != field && array->GetName() != nullptr) image.arrays.push_back(point_array(array));
  }
  return image;
}

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> split_image(vtkImageData* image, vtkDataArray* field,
                                                 std::optional<double> above) {
  if (field == nullptr) throw Error("the image has no point array to analyse");
  if (field->GetNumberOfComponents() != 1) {
    throw Error(std::string("array '") + (field->GetName() != nullptr ? field->GetName() : "") + "' has " +
                std::to_string(field->GetNumberOfComponents()) + " components, not 1");
  }
  const io::Dataset dataset = io::split_voxels(image_of(image, field), above);
  const auto corners = vtkSmartPointer<vtkTypeInt32Array>::New();
  corners->SetNumberOfValues(static_cast<vtkIdType>(4 * dataset.tetrahedra.extent(0)));
  std::copy_n(dataset.tetrahedra.data(), 4 * dataset.tetrahedra.extent(0), corners->GetPointer(0));
  const auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(4, corners);
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(points_of(dataset.points));
  grid->SetCells(VTK_TETRA, cells);
  add(dataset.arrays, grid->GetPointData());
  return grid;
}

}  // namespace gale::vtk
