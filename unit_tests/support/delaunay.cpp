#include "support/input_mesh.hpp"

#ifdef GALE_ENABLE_VTK

#include <random>

#include <vtkDelaunay3D.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

namespace gale::test {

InputMesh delaunay_mesh(Id count) {
  std::mt19937 random(42);
  vtkNew<vtkPoints> points;
  for (Id i = 0; i < count; ++i) {
    const double x = random() / 4294967296.0, y = random() / 4294967296.0, z = random() / 4294967296.0;
    points->InsertNextPoint(x, y, z);
  }
  vtkNew<vtkUnstructuredGrid> cloud;
  cloud->SetPoints(points);
  vtkNew<vtkDelaunay3D> delaunay;
  delaunay->SetInputData(cloud);
  delaunay->Update();
  vtkUnstructuredGrid* const grid = delaunay->GetOutput();

  InputMesh mesh;
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i) {
    mesh.points.emplace_back();
    grid->GetPoint(i, mesh.points.back().data());
  }
  for (vtkIdType t = 0; t < grid->GetNumberOfCells(); ++t) {
    vtkIdType corners = 0;
    const vtkIdType* corner = nullptr;
    grid->GetCellPoints(t, corners, corner);
    if (corners != 4) continue;
    mesh.tetrahedra.push_back({Id(corner[0]), Id(corner[1]), Id(corner[2]), Id(corner[3])});
  }
  return mesh;
}

}  // namespace gale::test

#else

namespace gale::test {

InputMesh delaunay_mesh(Id) { return {}; }

}  // namespace gale::test

#endif
