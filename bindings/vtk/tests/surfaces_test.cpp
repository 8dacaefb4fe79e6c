#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkFloatArray.h>
#include <vtkGaleCriticalPoints.h>
#include <vtkGaleMorseSmaleComplex.h>
#include <vtkGaleSegmentation.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStripper.h>
#include <vtkUnstructuredGrid.h>

#include <gale/algorithms/critical_points.hpp>
#include <gale/mesh/make_mesh.hpp>

#include "fixtures.hpp"

namespace gale::test {
namespace {

/// A sphere whose field is a wave.
vtkSmartPointer<vtkPolyData> sphere() {
  constexpr int around = 40, rings = 30;  // and a point at each pole
  constexpr double half_turn = 3.141592653589793;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> triangles;
  points->InsertNextPoint(0, 0, 0.5);
  points->InsertNextPoint(0, 0, -0.5);
  const auto at = [](int ring, int k) -> vtkIdType {
    return ring < 0 ? 0 : ring == rings ? 1 : 2 + ring * around + k % around;
  };
  for (int ring = 0; ring < rings; ++ring) {
    const double down = half_turn * (ring + 1) / (rings + 1);
    for (int k = 0; k < around; ++k) {
      const double turn = 2 * half_turn * k / around;
      points->InsertNextPoint(0.5 * std::sin(down) * std::cos(turn), 0.5 * std::sin(down) * std::sin(turn),
                              0.5 * std::cos(down));
    }
  }
  for (int ring = -1; ring < rings; ++ring) {
    for (int k = 0; k < around; ++k) {
      const vtkIdType low[] = {at(ring, k), at(ring + 1, k), at(ring + 1, k + 1)};
      const vtkIdType high[] = {at(ring, k), at(ring + 1, k + 1), at(ring, k + 1)};
      if (ring + 1 < rings) triangles->InsertNextCell(3, low);
      if (ring >= 0) triangles->InsertNextCell(3, high);
    }
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(points);
  surface->SetPolys(triangles);
  vtkNew<vtkFloatArray> field;
  field->SetName("wave");
  for (vtkIdType v = 0; v < surface->GetNumberOfPoints(); ++v) {
    const double* const p = surface->GetPoint(v);
    field->InsertNextValue(static_cast<float>(std::sin(9 * p[0]) * std::cos(8 * p[1]) + p[2]));
  }
  surface->GetPointData()->SetScalars(field);
  return surface;
}

/// What the library finds on the same triangles.
CriticalPoints expected_on(vtkPolyData* surface) {
  std::vector<double> points;
  std::vector<Id> corners;
  for (vtkIdType v = 0; v < surface->GetNumberOfPoints(); ++v) {
    const double* const p = surface->GetPoint(v);
    points.insert(points.end(), p, p + 3);
  }
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell) {
    surface->GetCellPoints(cell, ids);
    for (vtkIdType k = 0; k < 3; ++k) corners.push_back(static_cast<Id>(ids->GetId(k)));
  }
  using Rows = Kokkos::LayoutRight;
  const Kokkos::View<double* [3], Rows, HostMemory, Kokkos::MemoryUnmanaged> p(points.data(), points.size() / 3);
  const Kokkos::View<Id* [3], Rows, HostMemory, Kokkos::MemoryUnmanaged> t(corners.data(), corners.size() / 3);
  const Mesh mesh = make_mesh(p, t);
  auto* const field = vtkFloatArray::SafeDownCast(surface->GetPointData()->GetScalars());
  return find_critical_points(VertexOrder(mesh, field->GetPointer(0), points.size() / 3));
}

TEST(Surfaces, HaveTheCriticalPointsThatTheLibraryFinds) {
  const auto surface = sphere();
  const CriticalPoints expected = expected_on(surface);
  vtkNew<vtkStripper> stripper;
  stripper->SetInputData(surface);
  stripper->Update();
  vtkPolyData* const strips = stripper->GetOutput();
  ASSERT_GT(strips->GetNumberOfStrips(), 0);
  for (vtkPolyData* const input : {surface.Get(), strips}) {
    vtkNew<vtkGaleCriticalPoints> filter;
    filter->SetInputData(input);
    EXPECT_EQ(error_of(*filter), "no error");
    auto* const found = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
    ASSERT_EQ(found->GetNumberOfPoints(), static_cast<vtkIdType>(expected.vertices.size()));
    auto* const vertices = found->GetPointData()->GetArray("ttkVertexScalarField");
    auto* const types = found->GetPointData()->GetArray("CriticalType");
    for (std::size_t k = 0; k < expected.vertices.size(); ++k) {
      EXPECT_EQ(vertices->GetTuple1(static_cast<vtkIdType>(k)), expected.vertices[k]);
      EXPECT_EQ(types->GetTuple1(static_cast<vtkIdType>(k)), static_cast<int>(expected.types[k]));
    }
  }
}

TEST(Surfaces, HaveAComplexAndSegments) {
  const auto surface = sphere();
  vtkNew<vtkGaleMorseSmaleComplex> complex;
  complex->SetInputData(surface);
  EXPECT_EQ(error_of(*complex), "no error");
  auto* const critical = vtkPolyData::SafeDownCast(complex->GetOutputDataObject(0));
  auto* const dimensions = critical->GetPointData()->GetArray("CellDimension");
  int euler = 0;
  for (vtkIdType k = 0; k < critical->GetNumberOfPoints(); ++k)
    euler += static_cast<int>(dimensions->GetTuple1(k)) % 2 == 0 ? 1 : -1;
  EXPECT_EQ(euler, 2);
  vtkNew<vtkGaleSegmentation> segments;
  segments->SetInputData(surface);
  EXPECT_EQ(error_of(*segments), "no error");
  EXPECT_EQ(vtkDataSet::SafeDownCast(segments->GetOutputDataObject(0))->GetNumberOfCells(),
            surface->GetNumberOfCells());
}

TEST(Surfaces, OfFlatImagesAreTwoTrianglesASquare) {
  vtkNew<vtkImageData> image;
  image->SetDimensions(5, 7, 1);
  vtkNew<vtkFloatArray> field;
  field->SetName("x");
  for (int k = 0; k < 35; ++k) field->InsertNextValue(static_cast<float>(k % 5));
  image->GetPointData()->SetScalars(field);
  vtkNew<vtkGaleSegmentation> filter;
  filter->SetInputData(image);
  EXPECT_EQ(error_of(*filter), "no error");
  auto* const found = vtkUnstructuredGrid::SafeDownCast(filter->GetOutputDataObject(0));
  EXPECT_EQ(found->GetNumberOfCells(), 2 * 4 * 6);
  EXPECT_EQ(found->GetCellType(0), VTK_TRIANGLE);
}

}  // namespace
}  // namespace gale::test
