#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkGaleCriticalPoints.h>
#include <vtkGaleSegmentation.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStructuredGrid.h>
#include <vtkUniformGrid.h>
#include <vtkUnsignedCharArray.h>

#include "inputs.hpp"

namespace gale::test {
namespace {

/// One grid as VTK's types of data sets have it: an image or a single layer of one.
class VisibleCells : public Inputs {
 protected:
  /// The grid of so many points along each axis, with the first of all values.
  vtkSmartPointer<vtkUniformGrid> image(int nx, int ny, int nz) const {
    auto grid = vtkSmartPointer<vtkUniformGrid>::New();
    grid->SetDimensions(nx, ny, nz);
    vtkNew<vtkFloatArray> field;
    field->SetName("field");
    for (vtkIdType k = 0; k < grid->GetNumberOfPoints(); ++k)
      field->InsertNextValue(static_cast<float>(grid_->GetPointData()->GetScalars()->GetTuple1(k)));
    grid->GetPointData()->SetScalars(field);
    return grid;
  }

  static vtkSmartPointer<vtkDataSet> rectilinear(vtkImageData* image) {
    auto grid = vtkSmartPointer<vtkRectilinearGrid>::New();
    grid->SetDimensions(image->GetDimensions());
    vtkNew<vtkDoubleArray> axes[3];
    for (int d = 0; d < 3; ++d) {
      for (int k = 0; k < image->GetDimensions()[d]; ++k) axes[d]->InsertNextValue(k);
    }
    grid->SetXCoordinates(axes[0]);
    grid->SetYCoordinates(axes[1]);
    grid->SetZCoordinates(axes[2]);
    return grid;
  }

  static vtkSmartPointer<vtkPoints> points(vtkDataSet* of) {
    auto points = vtkSmartPointer<vtkPoints>::New();
    for (vtkIdType k = 0; k < of->GetNumberOfPoints(); ++k) points->InsertNextPoint(of->GetPoint(k));
    return points;
  }

  static vtkSmartPointer<vtkDataSet> structured(vtkImageData* image) {
    auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
    grid->SetDimensions(image->GetDimensions());
    grid->SetPoints(points(image));
    return grid;
  }

  /// Its voxels, or polyhedra of as many corners.
  static vtkSmartPointer<vtkDataSet> unstructured(vtkImageData* image, bool as_polyhedra) {
    auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    grid->SetPoints(points(image));
    vtkNew<vtkIdList> p, faces;
    for (vtkIdType cell = 0; cell < image->GetNumberOfCells(); ++cell) {
      image->GetCellPoints(cell, p);
      faces->Reset();
      faces->InsertNextId(6);
      for (const auto& face :
           {std::vector<int>{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}) {
        faces->InsertNextId(4);
        for (const int corner : face) faces->InsertNextId(as_polyhedra ? p->GetId(corner) : 0);
      }
      as_polyhedra ? grid->InsertNextCell(VTK_POLYHEDRON, faces) : grid->InsertNextCell(image->GetCellType(cell), p);
    }
    return grid;
  }

  static vtkSmartPointer<vtkDataSet> surface(vtkImageData* image) {
    auto quads = vtkSmartPointer<vtkPolyData>::New();
    quads->SetPoints(points(image));
    vtkNew<vtkCellArray> cells;
    vtkNew<vtkIdList> p;
    for (vtkIdType cell = 0; cell < image->GetNumberOfCells(); ++cell) {
      image->GetCellPoints(cell, p);
      const vtkIdType around[] = {p->GetId(0), p->GetId(1), p->GetId(3), p->GetId(2)};
      cells->InsertNextCell(4, around);
    }
    quads->SetPolys(cells);
    return quads;
  }

  static void mark(vtkDataSetAttributes* attributes, vtkIdType rows, const std::vector<vtkIdType>& marked, int bit) {
    vtkNew<vtkUnsignedCharArray> ghosts;
    ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
    ghosts->SetNumberOfValues(rows);
    ghosts->FillValue(0);
    for (const vtkIdType row : marked) ghosts->SetValue(row, static_cast<unsigned char>(bit));
    attributes->AddArray(ghosts);
  }

  /// Place, vertex, value and type of each critical point.
  static std::vector<double> critical_points_of(vtkDataSet* input) {
    vtkNew<vtkGaleCriticalPoints> filter;
    filter->SetInputData(input);
    EXPECT_EQ(error_of(*filter), "no error") << input->GetClassName();
    std::vector<double> all;
    vtkPolyData* const points = filter->GetOutput();
    for (vtkIdType k = 0; k < points->GetNumberOfPoints(); ++k) {
      all.insert(all.end(), points->GetPoint(k), points->GetPoint(k) + 3);
      for (const char* const name : {"ttkVertexScalarField", "field", "CriticalType"})
        all.push_back(points->GetPointData()->GetArray(name)->GetTuple1(k));
    }
    return all;
  }

  /// An image, and what else has its cells, without the cells around a point: where its value is NaN, where it is
  /// hidden, and where they are hidden themselves.
  void expect_hidden(vtkUniformGrid* image, const std::vector<vtkSmartPointer<vtkDataSet>>& others, vtkIdType point) {
    vtkNew<vtkIdList> around;
    std::vector<vtkIdType> cells;
    for (vtkIdType cell = 0; cell < image->GetNumberOfCells(); ++cell) {
      image->GetCellPoints(cell, around);
      if (around->IsId(point) >= 0) cells.push_back(cell);
    }
    const double value = image->GetPointData()->GetScalars()->GetTuple1(point);
    image->GetPointData()->GetScalars()->SetTuple1(point, std::numeric_limits<double>::quiet_NaN());
    const auto expected = critical_points_of(image);
    ASSERT_GT(expected.size(), 6u);
    using Attributes = vtkDataSetAttributes;
    for (const auto& input : others) {
      SCOPED_TRACE(input->GetClassName());
      for (const int bit :
           std::initializer_list<int>{Attributes::HIDDENCELL, Attributes::DUPLICATECELL, Attributes::REFINEDCELL, 0}) {
        SCOPED_TRACE(bit);
        input->GetPointData()->SetScalars(image->GetPointData()->GetScalars());
        bit == 0 ? mark(input->GetPointData(), input->GetNumberOfPoints(), {point}, Attributes::HIDDENPOINT)
                 : mark(input->GetCellData(), input->GetNumberOfCells(), cells, bit);
        input->Modified();
        EXPECT_EQ(critical_points_of(input), expected);
        vtkNew<vtkGaleSegmentation> filter;
        filter->SetInputData(input);
        filter->Update();
        EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), image->GetNumberOfPoints() - 1);
        const vtkIdType left = image->GetNumberOfCells() - static_cast<vtkIdType>(cells.size());
        const int split = vtkPointSet::SafeDownCast(input) ? 1 : image->GetDataDimension() == 3 ? 6 : 2;
        EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), split * left);
        input->GetPointData()->Initialize();
        input->GetCellData()->Initialize();
      }
    }
    image->GetPointData()->GetScalars()->SetTuple1(point, value);
  }
};

TEST_F(VisibleCells, OfAllInputsAreTheMesh) {
  const auto cube = image(n, n, n);
  const std::vector<vtkSmartPointer<vtkDataSet>> of_cube = {image(n, n, n), rectilinear(cube), structured(cube),
                                                            unstructured(cube, false), unstructured(cube, true)};
  for (const vtkIdType point : {0, 62}) expect_hidden(cube, of_cube, point);  // a corner, and one inside
  const auto flat = image(n, 1, n);
  const std::vector<vtkSmartPointer<vtkDataSet>> of_flat = {image(n, 1, n), rectilinear(flat), structured(flat),
                                                            unstructured(flat, false), surface(flat)};
  for (const vtkIdType point : {0, 12}) expect_hidden(flat, of_flat, point);
}

TEST_F(VisibleCells, WhereThereAreNoneOutputsAreEmpty) {
  const auto cube = image(n, n, n);
  for (const vtkSmartPointer<vtkDataSet>& input :
       {vtkSmartPointer<vtkDataSet>(cube.Get()), unstructured(cube, false), structured(cube)}) {
    input->GetPointData()->SetScalars(cube->GetPointData()->GetScalars());
    mark(input->GetCellData(), input->GetNumberOfCells(), {}, 0);
    input->GetCellData()->GetArray(0)->Fill(vtkDataSetAttributes::HIDDENCELL);
    expect_line(input, "");
    EXPECT_TRUE(critical_points_of(input).empty());
  }
}

TEST_F(VisibleCells, NameNoPointsThatAreNotThere) {
  const vtkIdType corners[] = {0, 1, 2, 999};
  grid_->InsertNextCell(VTK_TETRA, 4, corners);
  const auto expect_refused = [&] {
    vtkNew<vtkGaleSegmentation> filter;
    filter->SetInputData(grid_);
    EXPECT_NE(error_of(*filter).find("cell 384 names point 999 of 125"), std::string::npos);
  };
  mark(grid_->GetCellData(), grid_->GetNumberOfCells(), {7}, vtkDataSetAttributes::HIDDENCELL);
  expect_refused();
  grid_->GetCellData()->Initialize();
  mark(grid_->GetPointData(), grid_->GetNumberOfPoints(), {7}, vtkDataSetAttributes::HIDDENPOINT);
  expect_refused();
}

}  // namespace
}  // namespace gale::test
