#include "fixtures.hpp"

#include <cstring>
#include <sstream>

#include <gtest/gtest.h>
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkExecutive.h>
#include <vtkFloatArray.h>
#include <vtkGenericDataObjectWriter.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>

#include <gale/io/synthetic.hpp>

namespace gale::test {

namespace {

vtkSmartPointer<vtkFloatArray> field_of(const io::Dataset& dataset) {
  const auto& values = std::get<std::vector<float>>(dataset.arrays.at(0).values);
  auto field = vtkSmartPointer<vtkFloatArray>::New();
  field->SetName("field");
  for (const float value : values) field->InsertNextValue(value);
  return field;
}

void keep_error(vtkObject*, unsigned long, void* kept, void* text) {
  *static_cast<std::string*>(kept) += static_cast<const char*>(text);
}

}  // namespace

io::Dataset synthetic(int n) { return io::make_grid(n); }

vtkSmartPointer<vtkUnstructuredGrid> grid_of(const io::Dataset& dataset) {
  const auto& xyz = std::get<io::Dataset::Points<float>>(dataset.points);
  const auto points = vtkSmartPointer<vtkPoints>::New();
  for (std::size_t k = 0; k < xyz.extent(0); ++k) points->InsertNextPoint(&xyz(k, 0));
  const auto cells = vtkSmartPointer<vtkCellArray>::New();
  for (std::size_t k = 0; k < dataset.tetrahedra.extent(0); ++k) {
    cells->InsertNextCell(4);
    for (int corner = 0; corner < 4; ++corner) cells->InsertCellPoint(dataset.tetrahedra(k, corner));
  }
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(points);
  const auto types = vtkSmartPointer<vtkUnsignedCharArray>::New();  // VTK 9.6 adds no other cells to those of one type
  types->SetNumberOfValues(cells->GetNumberOfCells());
  types->FillValue(VTK_TETRA);
  grid->SetCells(types, cells);
  grid->GetPointData()->SetScalars(field_of(dataset));
  return grid;
}

vtkSmartPointer<vtkImageData> image_of(const io::Dataset& dataset, int n) {
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(n, n, n);
  image->GetPointData()->SetScalars(field_of(dataset));
  return image;
}

io::Dataset points_alone(const io::Dataset& dataset) {
  io::Dataset alone;
  alone.points = dataset.points;
  return alone;
}

void expect_arrays(vtkFieldData* found, const std::vector<io::PointArray>& expected) {
  for (const io::PointArray& array : expected) {
    vtkDataArray* const one = found->GetArray(array.name.c_str());
    ASSERT_NE(one, nullptr) << array.name;
    EXPECT_EQ(one->GetNumberOfComponents(), array.components) << array.name;
    std::visit(
        [&](const auto& values) {
          ASSERT_EQ(one->GetDataTypeSize(), static_cast<int>(sizeof values[0])) << array.name;
          ASSERT_EQ(static_cast<std::size_t>(one->GetNumberOfValues()), values.size()) << array.name;
          EXPECT_EQ(std::memcmp(one->GetVoidPointer(0), values.data(), values.size() * sizeof values[0]), 0)
              << array.name;
        },
        array.values);
  }
}

void expect_points(vtkPolyData* found, const io::Dataset::Positions& expected) {
  std::visit(
      [&](const auto& xyz) {
        ASSERT_EQ(static_cast<std::size_t>(found->GetNumberOfPoints()), xyz.extent(0));
        for (std::size_t k = 0; k < xyz.extent(0); ++k) {
          for (int d = 0; d < 3; ++d) EXPECT_EQ(found->GetPoint(static_cast<vtkIdType>(k))[d], xyz(k, d));
        }
      },
      expected);
}

std::string error_of(vtkAlgorithm& filter) {
  return error_of(filter, [&] { filter.Update(); });
}

std::string error_of(vtkAlgorithm& filter, const std::function<void()>& update) {
  std::string error;
  const auto watch = vtkSmartPointer<vtkCallbackCommand>::New();
  watch->SetCallback(keep_error);
  watch->SetClientData(&error);
  const auto tag = filter.AddObserver(vtkCommand::ErrorEvent, watch);
  const auto other = filter.GetExecutive()->AddObserver(vtkCommand::ErrorEvent, watch);
  filter.Modified();
  update();
  filter.GetExecutive()->RemoveObserver(other);
  filter.RemoveObserver(tag);
  return error.empty() ? "no error" : error;
}

std::string warning_of(vtkAlgorithm& filter) {
  std::string warning;
  const auto watch = vtkSmartPointer<vtkCallbackCommand>::New();
  watch->SetCallback(keep_error);
  watch->SetClientData(&warning);
  const auto tag = filter.AddObserver(vtkCommand::WarningEvent, watch);
  filter.Update();
  filter.RemoveObserver(tag);
  return warning;
}

std::string content_of(vtkDataObject* data) {
  const auto writer = vtkSmartPointer<vtkGenericDataObjectWriter>::New();
  writer->WriteToOutputStringOn();
  writer->SetInputData(data);
  writer->Write();
  return writer->GetOutputStdString();
}

}  // namespace gale::test
