#include <Kokkos_Core.hpp>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <gale/outputs/segmentation.hpp>

#include "arrays.hpp"
#include "run.hpp"
#include "vtkGaleCriticalPoints.h"
#include "vtkGaleMorseSmaleComplex.h"
#include "vtkGaleSegmentation.h"

// The filters. What they compute is described in outputs/analyses.hpp, and what they have in common is
// vtkGaleAlgorithm.

vtkStandardNewMacro(vtkGaleCriticalPoints);
vtkStandardNewMacro(vtkGaleMorseSmaleComplex);
vtkStandardNewMacro(vtkGaleSegmentation);

vtkGaleCriticalPoints::vtkGaleCriticalPoints() : vtkGaleAlgorithm(1, -1) {}

vtkGaleCriticalPoints::~vtkGaleCriticalPoints() = default;

vtkPolyData* vtkGaleCriticalPoints::GetOutput() { return this->GetOutput(0); }

vtkPolyData* vtkGaleCriticalPoints::GetOutput(int port) {
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(port));
}

void vtkGaleCriticalPoints::Compute(gale::vtk::Run& run, vtkInformationVector* outputs) {
  run.analyse("critical-points", {}, outputs);
}

vtkGaleMorseSmaleComplex::vtkGaleMorseSmaleComplex() : vtkGaleAlgorithm(4, 3) {}

vtkGaleMorseSmaleComplex::~vtkGaleMorseSmaleComplex() = default;

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
  return vtkUnstructuredGrid::SafeDownCast(this->GetOutputDataObject(3));
}

void vtkGaleMorseSmaleComplex::Compute(gale::vtk::Run& run, vtkInformationVector* outputs) {
  gale::outputs::Settings settings;
  settings.flags = {{"descending_separatrices", this->ComputeDescendingSeparatrices1},
                    {"ascending_separatrices", this->ComputeAscendingSeparatrices1},
                    {"saddle_connectors", this->ComputeSaddleConnectors},
                    {"separatrices2", this->ComputeSeparatrices2},
                    {"descending_segmentation", this->ComputeDescendingSegmentation},
                    {"ascending_segmentation", this->ComputeAscendingSegmentation},
                    {"extrema_only", this->ExtremaOnly}};
  if (this->Simplify) settings.thresholds["persistence"] = {this->Persistence, this->PersistenceIsPercent};
  run.analyse("morse-smale", settings, outputs);
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

vtkGaleSegmentation::vtkGaleSegmentation() : vtkGaleAlgorithm(1, 0) {}

vtkGaleSegmentation::~vtkGaleSegmentation() = default;

vtkUnstructuredGrid* vtkGaleSegmentation::GetOutput() { return this->GetOutput(0); }

vtkUnstructuredGrid* vtkGaleSegmentation::GetOutput(int port) {
  return vtkUnstructuredGrid::SafeDownCast(this->GetOutputDataObject(port));
}

void vtkGaleSegmentation::Compute(gale::vtk::Run& run, vtkInformationVector* outputs) {
  run.give({gale::outputs::segments_of(run.mesh())}, outputs, 0);
}
