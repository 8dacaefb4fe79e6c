#include "vtkGaleCriticalPoints.h"

#include <Kokkos_Core.hpp>
#include <vtkInformation.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <gale/algorithms/critical_points.hpp>
#include <gale/outputs/critical_points.hpp>

#include "arrays.hpp"
#include "run.hpp"

vtkStandardNewMacro(vtkGaleCriticalPoints);

vtkGaleCriticalPoints::vtkGaleCriticalPoints() { this->SetNumberOfOutputPorts(1); }

vtkGaleCriticalPoints::~vtkGaleCriticalPoints() = default;

int vtkGaleCriticalPoints::FillOutputPortInformation(int, vtkInformation* info) {
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
  return 1;
}

vtkPolyData* vtkGaleCriticalPoints::GetOutput() { return this->GetOutput(0); }

vtkPolyData* vtkGaleCriticalPoints::GetOutput(int port) {
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(port));
}

void vtkGaleCriticalPoints::Compute(gale::vtk::Run& run, vtkInformationVector* outputs) {
  const auto order = run.order(run.field());
  const auto points = gale::find_critical_points(order, run.compute("Finding critical points", 0, 1));
  gale::vtk::to_poly_data(gale::outputs::to_point_set(run.dataset(), points), run.grid()->GetPointData(),
                          vtkPolyData::GetData(outputs, 0));
}
