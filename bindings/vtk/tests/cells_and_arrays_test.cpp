#include <limits>

#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkGaleAlgorithm.h>
#include <vtkGaleCriticalPoints.h>
#include <vtkGaleSimplifiedField.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStructuredGrid.h>

#include <gale/mesh/cells/cell_types.hpp>

#include "inputs.hpp"

namespace gale::test {
namespace {

TEST_F(Inputs, CellsOfEveryType) {
  int solid = 0, split = 0;
  for (int type = 0; type < VTK_NUMBER_OF_CELL_TYPES + 2; ++type) {
    SCOPED_TRACE(type);
    const auto cell = vtkSmartPointer<vtkCell>::Take(vtkGenericCell::InstantiateCell(type));
    std::vector<vtkIdType> points(cell && cell->GetNumberOfPoints() > 0 ? cell->GetNumberOfPoints() : 4);
    for (std::size_t k = 0; k < points.size(); ++k) points[k] = static_cast<vtkIdType>(2 * k);
    if (type == VTK_TETRA) points = {0, 2, 50, 124};
    const auto mixed = grid_of(dataset_);
    if (type == VTK_POLYHEDRON) {
      const vtkIdType faces[] = {3, 0, 2, 4, 3, 0, 2, 6, 3, 0, 4, 6, 3, 2, 4, 6};
      mixed->InsertNextCell(type, 4, points.data(), 4, faces);
    } else {
      mixed->InsertNextCell(type, static_cast<vtkIdType>(points.size()), points.data());
    }
    const CellType* const known = find_cell_type(type);
    const bool is_solid = known != nullptr && known->dimension == 3;
    if (cell) EXPECT_TRUE(known != nullptr && known->dimension == cell->GetCellDimension());
    const bool is_split = is_solid && known->plural != nullptr;
    solid += is_solid ? 1 : 0;
    split += is_split ? 1 : 0;
    std::string said = "has the unknown type " + std::to_string(type);
    if (known != nullptr) said = is_solid && !is_split ? std::string(" is a ") + known->name : "";
    if (cell && is_solid && !is_split) EXPECT_STREQ(known->name, cell->GetClassName());
    expect_line(mixed, said);
  }
  EXPECT_GT(solid, 15);
  EXPECT_EQ(split, 9);
}

TEST_F(Inputs, TetrahedraThatAreNone) {
  const auto with = [&](std::vector<vtkIdType> points) {
    const auto grid = grid_of(dataset_);
    grid->InsertNextCell(VTK_TETRA, static_cast<vtkIdType>(points.size()), points.data());
    return grid;
  };
  expect_line(with({0, 1, 2}), "is a vtkTetra of 3 points");
  expect_line(with({0, 1, 2, 50, 60}), "is a vtkTetra of 5 points");
  expect_line(with({0, 1, 2, 999}), "has vertex 999");
  expect_line(with({0, 1, 2, -1}), "has vertex -1");
  expect_line(with({0, 1, 2, 2}), "has vertex 2 twice");
  auto moved = grid_of(dataset_);
  moved->GetPoints()->SetPoint(7, std::numeric_limits<double>::infinity(), 0, 0);
  expect_line(moved, "point 7 has a coordinate that is not finite");
  vtkNew<vtkUnstructuredGrid> pointless;
  pointless->SetCells(VTK_TETRA, grid_->GetCells());
  expect_line(pointless, "tetrahedron 0 has vertex", "");
  vtkNew<vtkUnstructuredGrid> flat;
  const vtkIdType triangle[] = {0, 1, 5};
  flat->SetPoints(grid_->GetPoints());
  flat->GetPointData()->ShallowCopy(grid_->GetPointData());
  flat->InsertNextCell(VTK_TRIANGLE, 3, triangle);
  expect_line(flat, "");  // a mesh of one triangle
  vtkNew<vtkCellArray> line;
  line->InsertNextCell(3, triangle);
  vtkNew<vtkPolyData> lines;
  lines->SetPoints(grid_->GetPoints());
  lines->GetPointData()->ShallowCopy(grid_->GetPointData());
  lines->SetLines(line);
  expect_line(lines, "no cell has two or three dimensions: cell 0 is a vtkPolyLine");
}

TEST_F(Inputs, ArraysOfEveryType) {
  for (const int type : {VTK_BIT, VTK_CHAR, VTK_SIGNED_CHAR, VTK_UNSIGNED_CHAR, VTK_SHORT, VTK_UNSIGNED_SHORT, VTK_INT,
                         VTK_UNSIGNED_INT, VTK_LONG, VTK_UNSIGNED_LONG, VTK_LONG_LONG, VTK_UNSIGNED_LONG_LONG,
                         VTK_ID_TYPE, VTK_FLOAT, VTK_DOUBLE, VTK_STRING, VTK_VARIANT}) {
    SCOPED_TRACE(type);
    const auto array = vtkSmartPointer<vtkAbstractArray>::Take(vtkAbstractArray::CreateArray(type));
    array->SetName("one");
    array->SetNumberOfTuples(grid_->GetNumberOfPoints());
    for (vtkIdType k = 0; vtkDataArray::SafeDownCast(array) && k < grid_->GetNumberOfPoints(); ++k)
      vtkDataArray::SafeDownCast(array)->SetTuple1(k, type == VTK_BIT ? k % 2 : k % 7);
    const auto image = image_of(dataset_, n);
    const auto rectilinear = rectilinear_of({0, 1, 2, 3, 4});
    const auto grid = grid_of(dataset_);
    for (vtkDataSet* const input : std::initializer_list<vtkDataSet*>{image, rectilinear, grid}) {
      input->GetPointData()->AddArray(array);
      expect_line(input, "");  // the array travels
      for (const auto& filter : all()) {
        const std::string said = line(*filter, input, "one");
        const bool is_number = array->IsNumeric() && type != VTK_BIT;
        if (is_number) {
          EXPECT_EQ(said, "");
        } else if (!filter->IsA("vtkGaleSegmentation")) {
          EXPECT_NE(said.find("'one'"), std::string::npos) << said;
        }
      }
    }
  }
}

TEST_F(Inputs, ArraysThatAreNoField) {
  vtkNew<vtkDoubleArray> vectors, nan, few;
  vectors->SetName("vectors");
  vectors->SetNumberOfComponents(3);
  nan->SetName("nan");
  for (vtkDoubleArray* const array : {vectors.Get(), nan.Get()}) {
    array->SetNumberOfTuples(grid_->GetNumberOfPoints());
    array->Fill(1);
  }
  nan->SetValue(17, std::numeric_limits<double>::quiet_NaN());
  few->SetName("few");
  few->SetNumberOfTuples(3);
  few->Fill(1);
  for (const vtkSmartPointer<vtkDataSet>& input :
       {vtkSmartPointer<vtkDataSet>(grid_of(dataset_).Get()), vtkSmartPointer<vtkDataSet>(image_of(dataset_, n).Get()),
        vtkSmartPointer<vtkDataSet>(rectilinear_of({0, 1, 2, 3, 4}).Get())}) {
    SCOPED_TRACE(input->GetClassName());
    input->GetPointData()->AddArray(vectors);
    input->GetPointData()->AddArray(nan);
    for (const auto& filter : all()) {
      const bool needs_field = !filter->IsA("vtkGaleSegmentation") || !input->IsA("vtkUnstructuredGrid");
      const bool has_voxels = !input->IsA("vtkUnstructuredGrid");
      EXPECT_EQ(line(*filter, input, "vectors"), needs_field ? "array 'vectors' has 3 components, not 1" : "");
      EXPECT_EQ(line(*filter, input, "nothing"), "the input has no point array 'nothing'");
      // A voxel without a value is left out, a vertex without one is refused.
      const std::string of_nan = line(*filter, input, "nan");
      if (has_voxels || !needs_field) {
        EXPECT_EQ(of_nan, "");
      } else {
        EXPECT_NE(of_nan.find("17"), std::string::npos) << of_nan;
      }
    }
    input->GetPointData()->AddArray(few);
    expect_line(input, "array 'few' has 3 rows for 125 points");
    input->GetPointData()->Initialize();
    for (const auto& filter : all())
      EXPECT_EQ(line(*filter, input, "").empty(),
                filter->IsA("vtkGaleSegmentation") && input->IsA("vtkUnstructuredGrid"));
  }
}

TEST_F(Inputs, CellArraysOfOtherLengthsAreRefused) {
  vtkNew<vtkStructuredGrid> structured;
  structured->SetDimensions(n, n, n);
  structured->SetPoints(grid_->GetPoints());
  structured->GetPointData()->ShallowCopy(grid_->GetPointData());
  for (const vtkIdType rows : {0, 3, 1000}) {
    vtkNew<vtkDoubleArray> other;
    other->SetName("other");
    other->SetNumberOfTuples(rows);
    other->Fill(1);
    for (const vtkSmartPointer<vtkDataSet>& input :
         {vtkSmartPointer<vtkDataSet>(structured.Get()), vtkSmartPointer<vtkDataSet>(grid_of(dataset_).Get()),
          vtkSmartPointer<vtkDataSet>(image_of(dataset_, n).Get())}) {
      input->GetCellData()->AddArray(other);
      expect_line(input, "cell array 'other' has " + std::to_string(rows) + " rows for " +
                             std::to_string(input->GetNumberOfCells()) + " cells");
    }
  }
}

/// A field without a name, the active scalars, beside an array that has the name which GALE gives it otherwise.
TEST_F(Inputs, FieldsWithoutANameGetAFreeOne) {
  vtkNew<vtkFloatArray> other;
  other->SetName("field");
  for (vtkIdType k = 0; k < grid_->GetNumberOfPoints(); ++k) other->InsertNextValue(static_cast<float>(k % 7));
  for (const vtkSmartPointer<vtkDataSet>& input :
       {vtkSmartPointer<vtkDataSet>(grid_of(dataset_).Get()), vtkSmartPointer<vtkDataSet>(image_of(dataset_, n).Get()),
        vtkSmartPointer<vtkDataSet>(rectilinear_of({0, 1, 2, 3, 4}).Get())}) {
    SCOPED_TRACE(input->GetClassName());
    vtkNew<vtkGaleCriticalPoints> points;
    points->SetInputData(input);
    points->Update();
    vtkNew<vtkPolyData> expected;
    expected->ShallowCopy(points->GetOutput());
    input->GetPointData()->GetScalars()->SetName(nullptr);
    input->GetPointData()->AddArray(other);
    ASSERT_EQ(input->GetPointData()->GetNumberOfArrays(), 2);
    points->Modified();
    points->Update();
    ASSERT_EQ(points->GetOutput()->GetNumberOfPoints(), expected->GetNumberOfPoints());
    for (vtkIdType k = 0; k < expected->GetNumberOfPoints(); ++k)
      EXPECT_EQ(points->GetOutput()->GetPointData()->GetArray("field_")->GetTuple1(k),
                expected->GetPointData()->GetArray("field")->GetTuple1(k));
    vtkNew<vtkGaleSimplifiedField> simplified;
    simplified->SetInputData(input);
    simplified->SimplifyOn();
    simplified->SetPersistence(100);
    simplified->Update();
    vtkPointData* const found = simplified->GetOutput()->GetPointData();
    EXPECT_EQ(found->GetNumberOfArrays(), 3);
    ASSERT_TRUE(found->HasArray("field_Order") == 0 && found->HasArray("field__Order") == 1);
    EXPECT_EQ(found->GetScalars(), found->GetArray("field_"));
    points->SetInputConnection(simplified->GetOutputPort());
    points->Update();
    EXPECT_EQ(points->GetOutput()->GetNumberOfPoints(), 2) << "a minimum and a maximum are left";
    EXPECT_EQ(input->GetPointData()->GetScalars()->GetName(), nullptr);
  }
}

TEST_F(Inputs, WhatVTKSaysOfArraysTravels) {
  vtkNew<vtkDoubleArray> vectors, notes;
  vectors->SetName("vectors");
  vectors->SetNumberOfComponents(3);
  vectors->SetNumberOfTuples(grid_->GetNumberOfPoints());
  vectors->Fill(1);
  vectors->SetComponentName(2, "up");
  notes->SetName("notes");
  notes->InsertNextValue(7);
  vtkNew<vtkStructuredGrid> structured;
  structured->SetDimensions(n, n, n);
  structured->SetPoints(grid_->GetPoints());
  structured->GetPointData()->ShallowCopy(grid_->GetPointData());
  for (const vtkSmartPointer<vtkDataSet>& input :
       {vtkSmartPointer<vtkDataSet>(grid_.Get()), vtkSmartPointer<vtkDataSet>(structured.Get()),
        vtkSmartPointer<vtkDataSet>(image_of(dataset_, n).Get()),
        vtkSmartPointer<vtkDataSet>(rectilinear_of({0, 1, 2, 3, 4}).Get())}) {
    SCOPED_TRACE(input->GetClassName());
    input->GetPointData()->SetVectors(vectors);
    input->GetFieldData()->AddArray(notes);
    vtkNew<vtkGaleSimplifiedField> simplified;
    vtkNew<vtkGaleCriticalPoints> points;
    simplified->SetInputData(input);
    points->SetInputConnection(simplified->GetOutputPort());
    points->Update();
    vtkPointData* const found = simplified->GetOutput()->GetPointData();
    ASSERT_NE(found->GetScalars(), nullptr);
    EXPECT_STREQ(found->GetScalars()->GetName(), "field");
    EXPECT_EQ(found->GetVectors(), found->GetArray("vectors"));
    for (vtkPointData* const arrays : {found, points->GetOutput()->GetPointData()})
      EXPECT_STREQ(arrays->GetArray("vectors")->GetComponentName(2), "up");
    ASSERT_NE(simplified->GetOutput()->GetFieldData()->GetArray("notes"), nullptr);
    EXPECT_EQ(simplified->GetOutput()->GetFieldData()->GetArray("notes")->GetTuple1(0), 7);
  }
}

}  // namespace
}  // namespace gale::test
