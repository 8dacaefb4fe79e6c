#include "vtkGaleMorseSmaleComplex.h"

#include <Kokkos_Core.hpp>
#include <vtkDataArray.h>
#include <vtkInformation.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <gale/outputs/morse_smale.hpp>

#include "arrays.hpp"
#include "run.hpp"

vtkStandardNewMacro(vtkGaleMorseSmaleComplex);

namespace {

constexpr int segmentationPort = 3;

}

vtkGaleMorseSmaleComplex::vtkGaleMorseSmaleComplex() { this->SetNumberOfOutputPorts(segmentationPort + 1); }

vtkGaleMorseSmaleComplex::~vtkGaleMorseSmaleComplex() = default;

int vtkGaleMorseSmaleComplex::FillOutputPortInformation(int port, vtkInformation* info) {
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == segmentationPort ? "vtkUnstructuredGrid" : "vtkPolyData");
  return 1;
}

vtkPolyData* vtkGaleMorseSmaleComplex::GetOutput() { return this->GetCriticalPoints(); }

vtkDataObject* vtkGaleMorseSmaleComplex::GetOutput(int port) { return this->GetOutputDataObject(port); }

vtkPolyData* vtkGaleMorseSmaleComplex::GetCriticalPoints() {
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(0));
}

vtkPolyData* vtkGaleMorseSmaleComplex::GetSeparatrices1() {
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(1));
}

vtkPolyData* vtkGaleMorseSmaleComplex::GetSeparatrices2() {
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(2));
}

vtkUnstructuredGrid* vtkGaleMorseSmaleComplex::GetSegmentation() {
  return vtkUnstructuredGrid::SafeDownCast(this->GetOutputDataObject(segmentationPort));
}

void vtkGaleMorseSmaleComplex::Compute(gale::vtk::Run& run, vtkInformationVector* outputs) {
  gale::outputs::MorseSmaleRequest request;
  request.parts.descending_separatrices = this->ComputeDescendingSeparatrices1;
  request.parts.ascending_separatrices = this->ComputeAscendingSeparatrices1;
  request.parts.saddle_connectors = this->ComputeSaddleConnectors;
  request.parts.separatrices2 = this->ComputeSeparatrices2;
  request.parts.descending_manifolds = this->ComputeDescendingSegmentation;
  request.parts.ascending_manifolds = this->ComputeAscendingSegmentation;
  request.extrema_only = this->ExtremaOnly;
  if (this->Simplify) {
    request.persistence = gale::outputs::Persistence{this->Persistence, this->PersistenceIsPercent};
  }
  const auto field = run.field();
  const auto order = run.order(field);
  gale::Computed computed;
  const auto gradient = gale::find_discrete_gradient(order, run.compute("Pairing simplices", 0, 0.6), &computed);
  const auto found = gale::outputs::morse_smale(gradient, run.dataset(), field, request,
                                                run.compute("Tracing the complex", 0.6, 1), &computed);
  vtkPointData* const arrays = run.grid()->GetPointData();
  gale::vtk::to_poly_data(found.critical_points, arrays, vtkPolyData::GetData(outputs, 0));
  gale::vtk::to_poly_data(found.separatrices1, vtkPolyData::GetData(outputs, 1));
  gale::vtk::to_poly_data(found.separatrices2, vtkPolyData::GetData(outputs, 2));
  vtkUnstructuredGrid* const mesh = vtkUnstructuredGrid::GetData(outputs, segmentationPort);
  mesh->ShallowCopy(run.grid());
  gale::vtk::add(found.manifolds, mesh->GetPointData());
}

void vtkGaleMorseSmaleComplex::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Simplify: " << this->Simplify << "\n";
  os << indent << "Persistence: " << this->Persistence << "\n";
  os << indent << "PersistenceIsPercent: " << this->PersistenceIsPercent << "\n";
  os << indent << "ExtremaOnly: " << this->ExtremaOnly << "\n";
  os << indent << "ComputeDescendingSeparatrices1: " << this->ComputeDescendingSeparatrices1 << "\n";
  os << indent << "ComputeAscendingSeparatrices1: " << this->ComputeAscendingSeparatrices1 << "\n";
  os << indent << "ComputeSaddleConnectors: " << this->ComputeSaddleConnectors << "\n";
  os << indent << "ComputeSeparatrices2: " << this->ComputeSeparatrices2 << "\n";
  os << indent << "ComputeDescendingSegmentation: " << this->ComputeDescendingSegmentation << "\n";
  os << indent << "ComputeAscendingSegmentation: " << this->ComputeAscendingSegmentation << "\n";
}
