#include "visible_cells.hpp"

#include <algorithm>
#include <string>

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkIdList.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <gale/base/error.hpp>

namespace gale::vtk {

namespace {

using Attributes = vtkDataSetAttributes;

/// Which rows have one of these bits in vtkGhostType; empty where none has.
std::vector<bool> marked(Attributes* attributes, int bits) {
  auto* const ghosts = vtkUnsignedCharArray::SafeDownCast(attributes->GetArray(Attributes::GhostArrayName()));
  std::vector<bool> rows;
  for (vtkIdType row = 0; ghosts != nullptr && row < ghosts->GetNumberOfTuples(); ++row)
    rows.push_back((ghosts->GetTypedComponent(row, 0) & bits) != 0);
  if (std::find(rows.begin(), rows.end(), true) == rows.end()) rows.clear();
  return rows;
}

/// Throws gale::Error for a cell of a point that there is not.
void require_point(vtkIdType point, vtkIdType cell, vtkDataSet* mesh) {
  if (point >= 0 && point < mesh->GetNumberOfPoints()) return;
  throw Error("cell " + std::to_string(cell) + " names point " + std::to_string(point) + " of " +
              std::to_string(mesh->GetNumberOfPoints()));
}

/// Calls use(k) for each entry of a cell that is a point.
template <class Use>
void for_each_point(int type, vtkIdList* entries, const Use& use) {
  const vtkIdType count = entries->GetNumberOfIds();
  vtkIdType end = type == VTK_POLYHEDRON ? 1 : count;  // of a face, or of the cell
  for (vtkIdType k = type == VTK_POLYHEDRON ? 1 : 0; k < count; ++k) {
    if (k < end) {
      use(k);
    } else {
      end = k + 1 + entries->GetId(k);
    }
  }
}

/// Copies these rows of all arrays, one behind the other.
void copy_rows(Attributes* from, vtkIdList* rows, Attributes* to) {
  to->CopyAllOn();  // ids as well
  to->CopyAllocate(from, rows->GetNumberOfIds());
  for (vtkIdType k = 0; k < rows->GetNumberOfIds(); ++k) to->CopyData(from, rows->GetId(k), k);
}

/// All cells of another data set, with its points and arrays.
vtkSmartPointer<vtkUnstructuredGrid> unstructured(vtkPointSet* mesh) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(mesh->GetPoints());
  grid->GetPointData()->ShallowCopy(mesh->GetPointData());
  grid->GetCellData()->ShallowCopy(mesh->GetCellData());
  grid->AllocateEstimate(mesh->GetNumberOfCells(), 8);
  const auto ids = vtkSmartPointer<vtkIdList>::New();
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell) {
    mesh->GetCellPoints(cell, ids);
    grid->InsertNextCell(mesh->GetCellType(cell), ids);
  }
  return grid;
}

}  // namespace

void get_entries(vtkUnstructuredGrid* grid, vtkIdType cell, vtkIdList* entries) {
  if (grid->GetCellType(cell) == VTK_POLYHEDRON) {
    grid->GetFaceStream(cell, entries);
  } else {
    grid->GetCellPoints(cell, entries);
  }
}

std::vector<bool> invisible_cells(vtkDataSet* mesh) {
  std::vector<bool> cells =
      marked(mesh->GetCellData(), Attributes::HIDDENCELL | Attributes::REFINEDCELL | Attributes::DUPLICATECELL);
  const std::vector<bool> points = marked(mesh->GetPointData(), Attributes::HIDDENPOINT);
  if (points.empty()) return cells;
  cells.resize(static_cast<std::size_t>(mesh->GetNumberOfCells()));
  const auto ids = vtkSmartPointer<vtkIdList>::New();
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    mesh->GetCellPoints(static_cast<vtkIdType>(cell), ids);
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k) {
      require_point(ids->GetId(k), static_cast<vtkIdType>(cell), mesh);
      if (points[static_cast<std::size_t>(ids->GetId(k))]) cells[cell] = true;
    }
  }
  return cells;
}

vtkSmartPointer<vtkUnstructuredGrid> without(const std::vector<bool>& cells, vtkUnstructuredGrid* mesh) {
  const auto kept_cells = vtkSmartPointer<vtkIdList>::New(), kept_points = vtkSmartPointer<vtkIdList>::New(),
             entries = vtkSmartPointer<vtkIdList>::New();
  std::vector<vtkIdType> place(static_cast<std::size_t>(mesh->GetNumberOfPoints()), -1);
  const auto place_of = [&](vtkIdType k) -> vtkIdType& { return place[static_cast<std::size_t>(entries->GetId(k))]; };
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell) {
    if (cells[static_cast<std::size_t>(cell)]) continue;
    kept_cells->InsertNextId(cell);
    get_entries(mesh, cell, entries);
    for_each_point(mesh->GetCellType(cell), entries, [&](vtkIdType k) {
      require_point(entries->GetId(k), cell, mesh);
      place_of(k) = 0;
    });
  }
  for (std::size_t point = 0; point < place.size(); ++point) {
    if (place[point] == 0) place[point] = kept_points->InsertNextId(static_cast<vtkIdType>(point));
  }
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  if (mesh->GetPoints() != nullptr) {
    const auto points = vtkSmartPointer<vtkPoints>::Take(vtkPoints::New(mesh->GetPoints()->GetDataType()));
    mesh->GetPoints()->GetPoints(kept_points, points);
    grid->SetPoints(points);
  }
  grid->AllocateEstimate(kept_cells->GetNumberOfIds(), 8);
  for (vtkIdType cell = 0; cell < kept_cells->GetNumberOfIds(); ++cell) {
    const int type = mesh->GetCellType(kept_cells->GetId(cell));
    get_entries(mesh, kept_cells->GetId(cell), entries);
    for_each_point(type, entries, [&](vtkIdType k) { entries->SetId(k, place_of(k)); });
    grid->InsertNextCell(type, entries);
  }
  copy_rows(mesh->GetPointData(), kept_points, grid->GetPointData());
  copy_rows(mesh->GetCellData(), kept_cells, grid->GetCellData());
  return grid;
}

vtkSmartPointer<vtkUnstructuredGrid> visible_cells(vtkPointSet* mesh) {
  vtkSmartPointer<vtkUnstructuredGrid> grid = vtkUnstructuredGrid::SafeDownCast(mesh);
  if (!grid) grid = unstructured(mesh);
  const std::vector<bool> left_out = invisible_cells(grid);
  return left_out.empty() ? grid : without(left_out, grid);
}

}  // namespace gale::vtk
