#include "grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkRectilinearGrid.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <gale/base/error.hpp>
#include <gale/io/image.hpp>
#include <gale/mesh/make_mesh.hpp>

#include "arrays.hpp"
#include "visible_cells.hpp"

namespace gale::vtk {

namespace {

template <class Array, class Coordinate>
bool take(vtkDataArray* data, io::Dataset::Positions& to) {
  auto* const plain = Array::SafeDownCast(data);
  if (plain == nullptr) return false;
  to = io::Dataset::Points<Coordinate>(plain->GetPointer(0), static_cast<std::size_t>(plain->GetNumberOfTuples()));
  return true;
}

template <class T>
Array<const T, HostMemory> view_of(const T* values, vtkIdType count) {
  return Array<const T, HostMemory>(values, static_cast<std::size_t>(count));
}

/// The mesh of cells whose points are at `corners`.
template <class Index>
Mesh mesh_of(const io::Dataset::Positions& points, const Index* corners, vtkIdType corner_count,
             const std::vector<std::int64_t>& offsets, const std::vector<std::uint8_t>& types, int capacity) {
  const auto count = [](const auto& values) { return static_cast<vtkIdType>(values.size()); };
  return std::visit(
      [&](const auto& xyz) {
        return make_mesh(xyz, view_of(corners, corner_count), view_of(offsets.data(), count(offsets)),
                         view_of(types.data(), count(types)), capacity);
      },
      points);
}

template <class Index>
Mesh mesh_of_tetrahedra(const io::Dataset::Positions& points, const Index* corners, vtkIdType count, int capacity) {
  const Tetrahedra<Index, HostMemory> tetrahedra(corners, static_cast<std::size_t>(count));
  return std::visit([&](const auto& xyz) { return make_mesh(xyz, tetrahedra, capacity); }, points);
}

bool has_tetrahedra_alone(vtkUnstructuredGrid* grid) {
  auto* const types = grid->GetCellTypesArray();
  const vtkIdType count = grid->GetNumberOfCells();
  if (types == nullptr || count == 0 || grid->GetCells()->IsHomogeneous() != 4) return false;
  const unsigned char* const all = types->GetPointer(0);
  return std::all_of(all, all + count, [](unsigned char type) { return type == VTK_TETRA; });
}

/// Throws gale::Error where no cell has two or three dimensions.
void require_dimension(const std::vector<std::uint8_t>& types) {
  const CellType* const first = find_cell_type(types.front());
  if (first == nullptr || highest_dimension(view_of(types.data(), static_cast<vtkIdType>(types.size()))) >= 2) return;
  throw Error(std::string("no cell has two or three dimensions: cell 0 is a ") + first->name);
}

/// The mesh of cells among which are polyhedra: VTK has their faces apart.
Mesh mesh_with_polyhedra(vtkUnstructuredGrid* grid, const std::vector<std::uint8_t>& types,
                         const io::Dataset::Positions& points, int capacity) {
  std::vector<std::int64_t> corners, offsets = {0};
  const auto ids = vtkSmartPointer<vtkIdList>::New();
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
    get_entries(grid, cell, ids);
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k) corners.push_back(ids->GetId(k));
    offsets.push_back(static_cast<std::int64_t>(corners.size()));
  }
  return mesh_of(points, corners.data(), static_cast<vtkIdType>(corners.size()), offsets, types, capacity);
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
  vtkCellArray* const cells = grid->GetCells();
  const vtkIdType count = cells->GetNumberOfCells(), corner_count = cells->GetConnectivityArray()->GetNumberOfTuples();
  const void* const corners = cells->GetConnectivityArray()->GetVoidPointer(0);
  const auto read_in_place = [&](const auto& use) {
    if (cells->IsStorage64Bit()) return use(static_cast<const std::int64_t*>(corners));
    return use(static_cast<const std::int32_t*>(corners));
  };
  if (has_tetrahedra_alone(grid))
    return read_in_place([&](const auto* ids) { return mesh_of_tetrahedra(points, ids, count, capacity); });
  std::vector<std::uint8_t> types;
  std::vector<std::int64_t> offsets = {0};
  for (vtkIdType cell = 0; cell < count; ++cell) {
    types.push_back(static_cast<std::uint8_t>(grid->GetCellType(cell)));
    offsets.push_back(offsets.back() + cells->GetCellSize(cell));
  }
  require_dimension(types);
  if (std::find(types.begin(), types.end(), VTK_POLYHEDRON) != types.end())
    return mesh_with_polyhedra(grid, types, points, capacity);
  return read_in_place([&](const auto* ids) { return mesh_of(points, ids, corner_count, offsets, types, capacity); });
}

namespace {

void place(vtkImageData* from, io::Image& image) {
  int extent[6];
  from->GetExtent(extent);
  from->GetDimensions(image.dimensions.data());
  for (int d = 0; d < 3; ++d) {
    auto& row = image.index_to_physical[d];
    row[3] = from->GetOrigin()[d];
    for (int k = 0; k < 3; ++k) {
      row[k] = from->GetDirectionMatrix()->GetElement(d, k) * from->GetSpacing()[k];
      row[3] += row[k] * extent[2 * k];
    }
  }
}

/// Adds the arrays of all voxels, the field first and no other of its name.
void add_arrays(vtkPointData* from, vtkDataArray* field, io::Image& image) {
  image.arrays.push_back(point_array(field));
  for (int k = 0; k < from->GetNumberOfArrays(); ++k) {
    vtkDataArray* const array = from->GetArray(k);
    if (array == nullptr || array->GetName() == nullptr || image.arrays[0].name == array->GetName()) continue;
    if (array->GetDataType() != VTK_BIT) image.arrays.push_back(point_array(array));
  }
}

/// Makes arrays active that have the names of those that are so elsewhere, and names all components as there.
void copy_roles(vtkPointData* from, vtkPointData* to) {
  for (int k = 0; k < to->GetNumberOfArrays(); ++k)
    to->GetArray(k)->CopyComponentNames(from->GetArray(to->GetArrayName(k)));
  for (int role = 0; role < vtkDataSetAttributes::NUM_ATTRIBUTES; ++role) {
    vtkAbstractArray* const active = from->GetAbstractAttribute(role);
    if (active != nullptr && active->GetName() != nullptr) to->SetActiveAttribute(active->GetName(), role);
  }
}

/// Which simplices of a grid are of these cells of its image.
std::vector<bool> simplices_of(const std::vector<bool>& cells, const Grid& grid) {
  const GridView view = grid.in<HostMemory>();
  std::vector<bool> simplices;
  for (Id cube = 0; cube < grid.cubes(); ++cube) {
    const auto [x, y, z] = view.place_of_cube(cube);
    const Offset cell = x + Offset(view.nx - 1) * (y + Offset(view.ny - 1) * z);
    simplices.insert(simplices.end(), static_cast<std::size_t>(view.cells_per_cube()), cells[cell]);
  }
  return simplices;
}

std::array<vtkDataArray*, 3> axes_of(vtkRectilinearGrid* grid) {
  return {grid->GetXCoordinates(), grid->GetYCoordinates(), grid->GetZCoordinates()};
}

/// The points that lie at these whole numbers along the axes of a grid.
vtkSmartPointer<vtkPoints> points_along(vtkRectilinearGrid* grid, vtkPoints* places) {
  const auto axes = axes_of(grid);
  const bool are_float =
      std::all_of(axes.begin(), axes.end(), [](auto* axis) { return vtkFloatArray::SafeDownCast(axis); });
  std::vector<double> along[3];
  for (int d = 0; d < 3; ++d) {
    for (vtkIdType k = 0; k < axes[d]->GetNumberOfTuples(); ++k) along[d].push_back(axes[d]->GetTuple1(k));
  }
  const auto points = vtkSmartPointer<vtkPoints>::Take(vtkPoints::New(are_float ? VTK_FLOAT : VTK_DOUBLE));
  points->SetNumberOfPoints(places->GetNumberOfPoints());
  for (vtkIdType k = 0; k < places->GetNumberOfPoints(); ++k) {
    double point[3];
    places->GetPoint(k, point);
    for (int d = 0; d < 3; ++d) point[d] = along[d][static_cast<std::size_t>(point[d])];
    points->SetPoint(k, point);
  }
  return points;
}

void require_axes(vtkRectilinearGrid* grid) {
  const auto axes = axes_of(grid);
  for (int d = 0; d < 3; ++d) {
    const vtkIdType count = axes[d] != nullptr ? axes[d]->GetNumberOfTuples() : 0;
    if (count != grid->GetDimensions()[d])
      throw Error("the grid has " + std::to_string(count) + " coordinates along axis " + "xyz"[d] + ", not " +
                  std::to_string(grid->GetDimensions()[d]));
    for (vtkIdType k = 0; k < count; ++k) {
      if (!std::isfinite(axes[d]->GetTuple1(k)))
        throw Error("coordinate " + std::to_string(k) + " along axis " + "xyz"[d] + " is not finite");
    }
  }
}

}  // namespace

Voxels voxels_of(vtkDataSet* voxels, vtkDataArray* field, std::optional<double> above) {
  io::Image image;
  auto* const rectilinear = vtkRectilinearGrid::SafeDownCast(voxels);
  if (rectilinear != nullptr) {
    require_axes(rectilinear);
    rectilinear->GetDimensions(image.dimensions.data());
  } else {
    place(vtkImageData::SafeDownCast(voxels), image);
  }
  if (field == nullptr) throw Error("the voxels have no point array to analyse");
  if (field->GetNumberOfComponents() != 1) {
    throw Error(std::string("array '") + (field->GetName() != nullptr ? field->GetName() : "") + "' has " +
                std::to_string(field->GetNumberOfComponents()) + " components, not 1");
  }
  add_arrays(voxels->GetPointData(), field, image);
  const io::Dataset dataset = io::split_voxels(std::move(image), above, io::GridCells::computed);
  auto mesh = vtkSmartPointer<vtkUnstructuredGrid>::New();
  const auto points = points_of(dataset.points);
  mesh->SetPoints(rectilinear != nullptr ? points_along(rectilinear, points) : points);
  add(dataset.arrays, mesh->GetPointData());
  copy_roles(voxels->GetPointData(), mesh->GetPointData());
  const std::vector<bool> left_out = invisible_cells(voxels);
  if (left_out.empty()) return {*dataset.grid, mesh};
  write_cells(*dataset.grid, mesh);
  return {std::nullopt, without(simplices_of(left_out, *dataset.grid), mesh)};
}

void write_cells(const Grid& grid, vtkUnstructuredGrid* mesh) {
  io::Dataset dataset;
  dataset.grid = grid;
  io::write_out_cells(dataset);
  const bool are_triangles = dataset.dimension() == 2;
  const Id* const simplices = are_triangles ? dataset.triangles.data() : dataset.tetrahedra.data();
  const vtkIdType count = are_triangles ? 3 : 4, entries = count * static_cast<vtkIdType>(dataset.cells());
  const auto corners = vtkSmartPointer<vtkTypeInt32Array>::New();
  corners->SetNumberOfValues(entries);
  std::copy_n(simplices, entries, corners->GetPointer(0));
  const auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(count, corners);
  mesh->SetCells(are_triangles ? VTK_TRIANGLE : VTK_TETRA, cells);
}

}  // namespace gale::vtk
