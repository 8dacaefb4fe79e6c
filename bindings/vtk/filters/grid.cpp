#include "grid.hpp"

#include <algorithm>
#include <limits>

#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkGenericCell.h>
#include <vtkPoints.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <gale/base/error.hpp>
#include <gale/mesh/make_mesh.hpp>

#include "arrays.hpp"

namespace gale::vtk {

namespace {

template <class Array, class Coordinate>
bool take(vtkDataArray* data, io::Dataset::Positions& to) {
  auto* const plain = Array::SafeDownCast(data);
  if (plain == nullptr) return false;
  to = io::Dataset::Points<Coordinate>(plain->GetPointer(0), static_cast<std::size_t>(plain->GetNumberOfTuples()));
  return true;
}

template <class Index>
Mesh mesh_of(const io::Dataset::Positions& points, const Index* corners, vtkIdType count, int capacity) {
  const Tetrahedra<Index, HostMemory> tetrahedra(corners, static_cast<std::size_t>(count));
  return std::visit([&](const auto& xyz) { return make_mesh(xyz, tetrahedra, capacity); }, points);
}

/// Whether a type of VTK's has dimension 3; so have those that VTK doesn't know, which are refused as well.
bool may_be_solid(int type) {
  const auto cell = vtkSmartPointer<vtkCell>::Take(vtkGenericCell::InstantiateCell(type));
  return !cell || cell->GetCellDimension() == 3;
}

[[noreturn]] void refuse(vtkIdType cell, int type) {
  const auto known = vtkSmartPointer<vtkCell>::Take(vtkGenericCell::InstantiateCell(type));
  if (!known)
    throw Error("cell " + std::to_string(cell) + " has type " + std::to_string(type) + ", which is none of VTK's");
  throw Error("cell " + std::to_string(cell) + " is a " + known->GetClassName() +
              ": vtkDataSetTriangleFilter makes tetrahedra of such");
}

/// The corners of the tetrahedra among cells of several types.
std::vector<std::int64_t> corners_among(vtkUnstructuredGrid* grid) {
  constexpr int types = std::numeric_limits<unsigned char>::max() + 1;  // of VTK's or not
  bool is_solid[types] = {};
  for (int type = 0; type < types; ++type) is_solid[type] = may_be_solid(type);
  std::vector<std::int64_t> corners;
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
    const int type = grid->GetCellType(cell);
    if (type == VTK_TETRA) {
      vtkIdType count;
      const vtkIdType* points;
      grid->GetCellPoints(cell, count, points);
      if (count != 4)
        throw Error("cell " + std::to_string(cell) + " is a tetrahedron of " + std::to_string(count) + " points");
      corners.insert(corners.end(), points, points + count);
    } else if (is_solid[type]) {
      refuse(cell, type);
    }
  }
  return corners;
}

bool has_tetrahedra_alone(vtkUnstructuredGrid* grid) {
  auto* const types = grid->GetCellTypesArray();
  const vtkIdType count = grid->GetNumberOfCells();
  if (types == nullptr || count == 0 || grid->GetCells()->IsHomogeneous() != 4) return false;
  const unsigned char* const all = types->GetPointer(0);
  return std::all_of(all, all + count, [](unsigned char type) { return type == VTK_TETRA; });
}

}  // namespace

io::Dataset::Positions positions_of(vtkUnstructuredGrid* grid) {
  io::Dataset::Positions positions;
  if (grid->GetPoints() == nullptr) return positions;
  vtkDataArray* const data = grid->GetPoints()->GetData();
  if (take<vtkFloatArray, float>(data, positions) || take<vtkDoubleArray, double>(data, positions)) return positions;
  const io::Dataset::Points<double> copy("GALE::points", static_cast<std::size_t>(data->GetNumberOfTuples()));
  for (vtkIdType k = 0; k < data->GetNumberOfTuples(); ++k) data->GetTuple(k, &copy(k, 0));
  return copy;
}

Mesh mesh_of(vtkUnstructuredGrid* grid, const io::Dataset::Positions& points, int capacity) {
  if (!has_tetrahedra_alone(grid)) {
    const std::vector<std::int64_t> corners = corners_among(grid);
    return mesh_of(points, corners.data(), static_cast<vtkIdType>(corners.size() / 4), capacity);
  }
  vtkCellArray* const cells = grid->GetCells();
  const vtkIdType count = cells->GetNumberOfCells();
  const void* const corners = cells->GetConnectivityArray()->GetVoidPointer(0);
  if (cells->IsStorage64Bit()) return mesh_of(points, static_cast<const std::int64_t*>(corners), count, capacity);
  return mesh_of(points, static_cast<const std::int32_t*>(corners), count, capacity);
}

}  // namespace gale::vtk
