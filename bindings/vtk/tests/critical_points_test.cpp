#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkGaleCriticalPoints.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSOADataArrayTemplate.h>
#include <vtkStringArray.h>
#include <vtkVariant.h>

#include <gale/algorithms/critical_points.hpp>
#include <gale/mesh/make_mesh.hpp>
#include <gale/outputs/critical_points.hpp>
#include <gale/outputs/field.hpp>
#include <gale/runtime/make_structure.hpp>

#include "fixtures.hpp"

namespace gale::test {
namespace {

constexpr int n = 11;

class CriticalPointsFilter : public testing::Test {
 protected:
  CriticalPointsFilter() : dataset_(synthetic(n)), grid_(grid_of(dataset_)) {
    const auto& points = std::get<io::Dataset::Points<float>>(dataset_.points);
    const Mesh mesh = make_mesh(points, dataset_.tetrahedra);
    const VertexOrder order = outputs::order_of(mesh, dataset_, dataset_.arrays.at(0));
    expected_ =
        outputs::to_point_set(dataset_, find_critical_points(*make_structure(mesh, critical_points_relations), order));
  }

  /// What the filter finds is what the library finds.
  void expect_all(vtkDataObject* input) {
    filter_->SetInputData(input);
    filter_->Update();
    expect_points(filter_->GetOutput(), expected_.points);
    expect_arrays(filter_->GetOutput()->GetPointData(), expected_.arrays);
    EXPECT_EQ(filter_->GetOutput()->GetNumberOfVerts(), filter_->GetOutput()->GetNumberOfPoints());
  }

  io::Dataset dataset_;
  vtkSmartPointer<vtkUnstructuredGrid> grid_;
  io::PointSet expected_;
  vtkNew<vtkGaleCriticalPoints> filter_;
};

TEST_F(CriticalPointsFilter, FindsWhatTheLibraryFinds) {
  ASSERT_GT(std::get<io::Dataset::Points<float>>(expected_.points).extent(0), 10u);
  expect_all(grid_);
}

TEST_F(CriticalPointsFilter, ReadsCellsOf32Bits) {
  grid_->GetCells()->ConvertTo32BitStorage();
  expect_all(grid_);
}

TEST_F(CriticalPointsFilter, SplitsImages) { expect_all(image_of(dataset_, n)); }

TEST_F(CriticalPointsFilter, TakesNoMoreThreadsThanTheSystemStarts) {
  filter_->SetNumberOfThreads(VTK_INT_MAX);
  EXPECT_EQ(filter_->GetNumberOfThreads(), 1024);
}

TEST_F(CriticalPointsFilter, ResultsDependOnNoThreadsAndNoSegments) {
  for (const int threads : {1, 3}) {
    filter_->SetNumberOfThreads(threads);
    filter_->SetCapacity(7 * threads);
    expect_all(grid_);
  }
}

TEST_F(CriticalPointsFilter, ReadsPointsAndFieldsOfOtherLayouts) {
  vtkNew<vtkSOADataArrayTemplate<float>> field;
  field->SetName("field");
  field->DeepCopy(grid_->GetPointData()->GetScalars());
  field->SetName("field");
  vtkNew<vtkSOADataArrayTemplate<double>> xyz;
  xyz->DeepCopy(grid_->GetPoints()->GetData());
  vtkNew<vtkPoints> points;
  points->SetData(xyz);
  grid_->SetPoints(points);
  grid_->GetPointData()->SetScalars(field);
  expect_all(grid_);
}

TEST_F(CriticalPointsFilter, LeavesOutCellsOfLowerDimension) {
  const vtkIdType corners[] = {0, 1, 2};
  grid_->InsertNextCell(VTK_TRIANGLE, 3, corners);
  grid_->InsertNextCell(VTK_VERTEX, 1, corners);
  expect_all(grid_);
}

TEST_F(CriticalPointsFilter, AllPointArraysTravel) {
  vtkNew<vtkStringArray> names;
  names->SetName("names");
  vtkNew<vtkDoubleArray> vectors;
  vectors->SetName("vectors");
  vectors->SetNumberOfComponents(3);
  for (vtkIdType k = 0; k < grid_->GetNumberOfPoints(); ++k) {
    names->InsertNextValue(std::to_string(k));
    vectors->InsertNextTuple3(k, 0, -k);
  }
  grid_->GetPointData()->AddArray(names);
  grid_->GetPointData()->AddArray(vectors);
  expect_all(grid_);
  vtkPointData* const found = filter_->GetOutput()->GetPointData();
  vtkDataArray* const places = found->GetArray("ttkVertexScalarField");
  for (vtkIdType k = 0; k < places->GetNumberOfTuples(); ++k) {
    const auto place = static_cast<vtkIdType>(places->GetTuple1(k));
    EXPECT_EQ(found->GetAbstractArray("names")->GetVariantValue(k).ToString(), std::to_string(place));
    EXPECT_EQ(found->GetArray("vectors")->GetComponent(k, 2), -place);
  }
}

TEST_F(CriticalPointsFilter, TakesTheArrayThatIsNamed) {
  vtkNew<vtkFloatArray> falling;
  falling->SetName("falling");
  for (vtkIdType k = 0; k < grid_->GetNumberOfPoints(); ++k)
    falling->InsertNextValue(static_cast<float>(-grid_->GetPointData()->GetScalars()->GetTuple1(k)));
  grid_->GetPointData()->AddArray(falling);
  filter_->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "falling");
  filter_->SetInputData(grid_);
  filter_->Update();
  const auto count = [](vtkPolyData* points, int type) {
    vtkDataArray* const types = points->GetPointData()->GetArray("CriticalType");
    int of_type = 0;
    for (vtkIdType k = 0; k < types->GetNumberOfTuples(); ++k) of_type += types->GetTuple1(k) == type ? 1 : 0;
    return of_type;
  };
  const int maxima = count(filter_->GetOutput(), 3);
  filter_->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "field");
  filter_->Update();
  EXPECT_EQ(maxima, count(filter_->GetOutput(), 0));
}

TEST_F(CriticalPointsFilter, OrdersByTheArrayBesideTheField) {
  vtkNew<vtkFloatArray> order;
  order->SetName("field_Order");
  for (vtkIdType k = 0; k < grid_->GetNumberOfPoints(); ++k) order->InsertNextValue(static_cast<float>(k));
  grid_->GetPointData()->AddArray(order);
  filter_->SetInputData(grid_);
  const std::string warning = warning_of(*filter_);
  EXPECT_NE(warning.find("'field_Order' orders the vertices, though it contradicts 'field'"), std::string::npos);
  EXPECT_EQ(filter_->GetOutput()->GetNumberOfPoints(), 2);  // a grid's first point and its last one
}

TEST_F(CriticalPointsFilter, ImagesHaveThresholdsAndPlacesInSpace) {
  const auto image = image_of(dataset_, n);
  image->SetOrigin(10, 20, 30);
  image->SetSpacing(2, 3, 4);
  image->SetDirectionMatrix(0, 1, 0, 1, 0, 0, 0, 0, 1);
  filter_->SetInputData(image);
  filter_->UseThresholdOn();
  filter_->SetThreshold(-0.25);
  filter_->Update();
  vtkPolyData* const found = filter_->GetOutput();
  ASSERT_GT(found->GetNumberOfPoints(), 5);
  vtkDataArray* const values = found->GetPointData()->GetArray("field");
  for (vtkIdType k = 0; k < found->GetNumberOfPoints(); ++k) {
    EXPECT_GT(values->GetTuple1(k), -0.25);
    double point[3];
    found->GetPoint(k, point);
    const vtkIdType voxel = image->FindPoint(point);
    EXPECT_EQ(image->GetPointData()->GetScalars()->GetTuple1(voxel), values->GetTuple1(k));
    for (int d = 0; d < 3; ++d) EXPECT_NEAR(image->GetPoint(voxel)[d], point[d], 1e-5);
  }
}

}  // namespace
}  // namespace gale::test
