#include "vtkGaleSegmentation.h"

#include <Kokkos_Core.hpp>
#include <vtkDataArray.h>
#include <vtkInformation.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

#include <gale/outputs/segmentation.hpp>

#include "arrays.hpp"
#include "run.hpp"

vtkStandardNewMacro(vtkGaleSegmentation);

vtkGaleSegmentation::vtkGaleSegmentation() { this->SetNumberOfOutputPorts(1); }

vtkGaleSegmentation::~vtkGaleSegmentation() = default;

int vtkGaleSegmentation::FillOutputPortInformation(int, vtkInformation* info) {
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkUnstructuredGrid");
  return 1;
}

vtkUnstructuredGrid* vtkGaleSegmentation::GetOutput() { return this->GetOutput(0); }

vtkUnstructuredGrid* vtkGaleSegmentation::GetOutput(int port) {
  return vtkUnstructuredGrid::SafeDownCast(this->GetOutputDataObject(port));
}

void vtkGaleSegmentation::Compute(gale::vtk::Run& run, vtkInformationVector* outputs) {
  vtkUnstructuredGrid* const output = vtkUnstructuredGrid::GetData(outputs, 0);
  output->ShallowCopy(run.grid());
  gale::vtk::add({gale::outputs::segments_of(run.mesh())}, output->GetPointData());
}
