#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkGaleMorseSmaleComplex.h>
#include <vtkGaleSegmentation.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <gale/mesh/make_mesh.hpp>
#include <gale/outputs/field.hpp>
#include <gale/outputs/morse_smale.hpp>
#include <gale/outputs/segmentation.hpp>
#include <gale/runtime/make_structure.hpp>

#include "fixtures.hpp"

namespace gale::test {
namespace {

constexpr int side = 11;  // vertices of the grid along each axis

class ComplexFilter : public testing::Test {
 protected:
  ComplexFilter() : dataset_(synthetic(side)), grid_(grid_of(dataset_)), mesh_(mesh_of(dataset_)) {}

  static Mesh mesh_of(const io::Dataset& dataset) {
    return make_mesh(std::get<io::Dataset::Points<float>>(dataset.points), dataset.tetrahedra);
  }

  /// What the filter finds is what the library finds.
  void expect_all(const outputs::MorseSmaleRequest& request) {
    const io::PointArray& field = dataset_.arrays.at(0);
    const auto structure = make_structure(mesh_, morse_smale_relations);
    const auto gradient = find_discrete_gradient(*structure, outputs::order_of(mesh_, dataset_, field));
    const auto expected = outputs::morse_smale(gradient, dataset_, field, request);
    filter_->SetInputData(grid_);
    filter_->Update();
    expect_points(filter_->GetCriticalPoints(), expected.critical_points.points);
    expect_arrays(filter_->GetCriticalPoints()->GetPointData(), expected.critical_points.arrays);
    expect_surface(filter_->GetSeparatrices1(), filter_->GetSeparatrices1()->GetLines(), expected.separatrices1,
                   expected.separatrices1.lines);
    expect_surface(filter_->GetSeparatrices2(), filter_->GetSeparatrices2()->GetPolys(), expected.separatrices2,
                   expected.separatrices2.polygons);
    EXPECT_EQ(filter_->GetSegmentation()->GetNumberOfCells(), grid_->GetNumberOfCells());
    expect_arrays(filter_->GetSegmentation()->GetPointData(), expected.manifolds);
    EXPECT_EQ(filter_->GetSegmentation()->GetPointData()->GetNumberOfArrays(),
              1 + static_cast<int>(expected.manifolds.size()));
  }

  static void expect_surface(vtkPolyData* found, vtkCellArray* cells, const io::Surface& expected,
                             const io::Surface::Cells& expected_cells) {
    expect_points(found, expected.points);
    expect_arrays(found->GetPointData(), expected.point_arrays);
    expect_arrays(found->GetCellData(), expected.cell_arrays);
    ASSERT_EQ(static_cast<std::size_t>(cells->GetNumberOfCells()) + 1, expected_cells.begin.size());
    for (vtkIdType k = 0; k < cells->GetNumberOfCells(); ++k) {
      vtkIdType count;
      const vtkIdType* points;
      cells->GetCellAtId(k, count, points);
      const auto begin = expected_cells.begin[k];
      ASSERT_EQ(count, expected_cells.begin[k + 1] - begin);
      for (vtkIdType i = 0; i < count; ++i) EXPECT_EQ(points[i], expected_cells.points[begin + i]);
    }
  }

  io::Dataset dataset_;
  vtkSmartPointer<vtkUnstructuredGrid> grid_;
  Mesh mesh_;
  vtkNew<vtkGaleMorseSmaleComplex> filter_;
};

TEST_F(ComplexFilter, FindsWhatTheLibraryFinds) { expect_all({}); }

TEST_F(ComplexFilter, Simplifies) {
  outputs::MorseSmaleRequest request;
  filter_->SimplifyOn();
  filter_->SetPersistence(5);
  request.persistence = outputs::Persistence{5, true};
  expect_all(request);
  filter_->PersistenceIsPercentOff();
  filter_->SetPersistence(0.02);
  request.persistence = outputs::Persistence{0.02, false};
  expect_all(request);
  filter_->ExtremaOnlyOn();
  request.extrema_only = true;
  expect_all(request);
}

TEST_F(ComplexFilter, HasThePartsThatAreWanted) {
  outputs::MorseSmaleRequest request;
  filter_->ComputeSeparatrices2On();
  request.parts.separatrices2 = true;
  expect_all(request);
  EXPECT_GT(filter_->GetSeparatrices2()->GetNumberOfCells(), 0);
  filter_->ComputeSaddleConnectorsOff();
  request.parts.saddle_connectors = false;
  expect_all(request);
  filter_->ComputeAscendingSegmentationOff();
  request.parts.ascending_manifolds = false;
  expect_all(request);
  filter_->ComputeDescendingSeparatrices1Off();
  filter_->ComputeAscendingSeparatrices1Off();
  request.parts.descending_separatrices = request.parts.ascending_separatrices = false;
  expect_all(request);
  EXPECT_EQ(filter_->GetSeparatrices1()->GetNumberOfCells(), 0);
  filter_->ComputeDescendingSegmentationOff();
  request.parts.descending_manifolds = false;
  expect_all(request);
}

TEST_F(ComplexFilter, SegmentsOfTheMesh) {
  vtkNew<vtkGaleSegmentation> segments;
  segments->SetInputData(grid_);
  segments->Update();
  expect_arrays(segments->GetOutput()->GetPointData(), {outputs::segments_of(mesh_)});
  EXPECT_EQ(segments->GetOutput()->GetCells(), grid_->GetCells()) << "they are shared";
  segments->SetCapacity(20);
  segments->Update();
  double range[2];
  segments->GetOutput()->GetPointData()->GetArray(outputs::segments_name)->GetRange(range);
  EXPECT_GE((range[1] + 1) * 20, grid_->GetNumberOfPoints());
  segments->SetInputDataObject(image_of(dataset_, side));
  segments->Update();
  EXPECT_EQ(segments->GetOutput()->GetNumberOfCells(), grid_->GetNumberOfCells());
}

}  // namespace
}  // namespace gale::test
