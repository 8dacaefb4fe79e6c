#include "voxels.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkRectilinearGrid.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnstructuredGrid.h>

#include <gale/base/error.hpp>
#include <gale/io/image.hpp>

#include "arrays.hpp"

namespace gale::vtk {

namespace {

void place(vtkImageData* from, io::Image& image) {
  int extent[6];
  from->GetExtent(extent);
  from->GetDimensions(image.dimensions.data());
  for (int d = 0; d < 3; ++d) {
    auto& row = image.index_to_physical[d];
    row[3] = from->GetOrigin()[d];
    for (int k = 0; k < 3; ++k) {
      row[k] = from->GetDirectionMatrix()->GetElement(d, k) * from->GetSpacing()[k];
      row[3] += row[k] * extent[2 * k];
    }
  }
}

/// Adds the arrays of all voxels, the field first.
void add_arrays(vtkPointData* from, vtkDataArray* field, io::Image& image) {
  image.arrays.push_back(point_array(field));
  if (image.arrays[0].name.empty()) image.arrays[0].name = "field";
  for (int k = 0; k < from->GetNumberOfArrays(); ++k) {
    vtkDataArray* const array = from->GetArray(k);
    if (array == nullptr || array == field || array->GetName() == nullptr) continue;
    if (array->GetDataType() != VTK_BIT) image.arrays.push_back(point_array(array));
  }
}

std::array<vtkDataArray*, 3> axes_of(vtkRectilinearGrid* grid) {
  return {grid->GetXCoordinates(), grid->GetYCoordinates(), grid->GetZCoordinates()};
}

/// The points that lie at these whole numbers along the axes of a grid.
vtkSmartPointer<vtkPoints> points_along(vtkRectilinearGrid* grid, vtkPoints* places) {
  const auto axes = axes_of(grid);
  const bool are_float =
      std::all_of(axes.begin(), axes.end(), [](auto* axis) { return vtkFloatArray::SafeDownCast(axis); });
  std::vector<double> along[3];
  for (int d = 0; d < 3; ++d) {
    for (vtkIdType k = 0; k < axes[d]->GetNumberOfTuples(); ++k) along[d].push_back(axes[d]->GetTuple1(k));
  }
  const auto points = vtkSmartPointer<vtkPoints>::Take(vtkPoints::New(are_float ? VTK_FLOAT : VTK_DOUBLE));
  points->SetNumberOfPoints(places->GetNumberOfPoints());
  for (vtkIdType k = 0; k < places->GetNumberOfPoints(); ++k) {
    double point[3];
    places->GetPoint(k, point);
    for (int d = 0; d < 3; ++d) point[d] = along[d][static_cast<std::size_t>(point[d])];
    points->SetPoint(k, point);
  }
  return points;
}

void require_axes(vtkRectilinearGrid* grid) {
  const auto axes = axes_of(grid);
  for (int d = 0; d < 3; ++d) {
    const vtkIdType count = axes[d] != nullptr ? axes[d]->GetNumberOfTuples() : 0;
    if (count == grid->GetDimensions()[d]) continue;
    throw Error("the grid has " + std::to_string(count) + " coordinates along axis " + "xyz"[d] + ", not " +
                std::to_string(grid->GetDimensions()[d]));
  }
}

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> split_voxels(vtkDataSet* voxels, vtkDataArray* field,
                                                  std::optional<double> above) {
  io::Image image;
  auto* const rectilinear = vtkRectilinearGrid::SafeDownCast(voxels);
  if (rectilinear != nullptr) {
    require_axes(rectilinear);
    rectilinear->GetDimensions(image.dimensions.data());
  } else {
    place(vtkImageData::SafeDownCast(voxels), image);
  }
  if (field == nullptr) throw Error("the voxels have no point array to analyse");
  if (field->GetNumberOfComponents() != 1) {
    throw Error(std::string("array '") + (field->GetName() != nullptr ? field->GetName() : "") + "' has " +
                std::to_string(field->GetNumberOfComponents()) + " components, not 1");
  }
  add_arrays(voxels->GetPointData(), field, image);
  const io::Dataset dataset = io::split_voxels(std::move(image), above);
  const auto corners = vtkSmartPointer<vtkTypeInt32Array>::New();
  corners->SetNumberOfValues(static_cast<vtkIdType>(4 * dataset.tetrahedra.extent(0)));
  std::copy_n(dataset.tetrahedra.data(), 4 * dataset.tetrahedra.extent(0), corners->GetPointer(0));
  const auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(4, corners);
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  const auto points = points_of(dataset.points);
  grid->SetPoints(rectilinear != nullptr ? points_along(rectilinear, points) : points);
  grid->SetCells(VTK_TETRA, cells);
  add(dataset.arrays, grid->GetPointData());
  return grid;
}

}  // namespace gale::vtk
