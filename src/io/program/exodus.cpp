#include <set>

#include <vtkCellArray.h>
#include <vtkDataObjectTreeIterator.h>
#include <vtkExodusIIReader.h>
#include <vtkIdList.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

#include "readers.hpp"

namespace gale::reader {

namespace {

void append_cells(vtkUnstructuredGrid* from, vtkUnstructuredGrid* to) {
  vtkNew<vtkIdList> points;
  for (vtkIdType cell = 0; cell < from->GetNumberOfCells(); ++cell) {
    from->GetCellPoints(cell, points);
    to->InsertNextCell(from->GetCellType(cell), points);
  }
}

/// Nodal variables alone, and not what the reader numbers points with.
void keep_variables(vtkExodusIIReader* reader, vtkPointData* arrays) {
  std::set<std::string> variables;
  for (int k = 0; k < reader->GetNumberOfPointResultArrays(); ++k) variables.insert(reader->GetPointResultArrayName(k));
  for (int k = arrays->GetNumberOfArrays(); k-- > 0;) {
    const char* const name = arrays->GetArrayName(k);
    if (name == nullptr || variables.count(name) == 0) arrays->RemoveArray(k);
  }
}

}  // namespace

FoundData read_exodus(const std::string& path) {
  vtkNew<vtkExodusIIReader> reader;
  if (reader->CanReadFile(path.c_str()) == 0) return {};
  reader->SetFileName(path.c_str());
  reader->UpdateInformation();
  reader->SetAllArrayStatus(vtkExodusIIReader::NODAL, 1);
  reader->ApplyDisplacementsOff();  // points are where the file has them
  reader->SetSqueezePoints(false);  // all blocks have all points, and number them alike
  reader->GenerateGlobalNodeIdArrayOff();
  reader->Update();
  vtkNew<vtkUnstructuredGrid> mesh;
  mesh->Allocate();
  auto* const elements = vtkMultiBlockDataSet::SafeDownCast(reader->GetOutput()->GetBlock(0));
  for (unsigned block = 0; elements != nullptr && block < elements->GetNumberOfBlocks(); ++block) {
    auto* const grid = vtkUnstructuredGrid::SafeDownCast(elements->GetBlock(block));
    if (grid == nullptr || grid->GetPoints() == nullptr) continue;
    if (mesh->GetPoints() == nullptr) {
      mesh->SetPoints(grid->GetPoints());
      mesh->GetPointData()->ShallowCopy(grid->GetPointData());
    }
    append_cells(grid, mesh);
  }
  keep_variables(reader, mesh->GetPointData());
  const int times = reader->GetNumberOfTimeSteps();
  return {mesh, times > 1 ? "left out all but the first of " + std::to_string(times) + " time steps" : ""};
}

}  // namespace gale::reader
