#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include <vtkAOSDataArrayTemplate.h>
#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkDataSetTriangleFilter.h>
#include <vtkGenericCell.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <gale/base/error.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/types.hpp>
#include <gale/io/vtk/vtk_convert.hpp>

namespace gale::io::detail {
namespace {

using Host = Kokkos::DefaultHostExecutionSpace;
using Tetrahedra = decltype(Dataset::tetrahedra);

/// The type of fixed width that `PointArray::Values` has for VTK's type T (char, long, vtkIdType ...).
template <class T>
auto fixed_type() {
  constexpr bool is_signed = std::is_signed_v<T>;
  if constexpr (std::is_floating_point_v<T>)
    return T();
  else if constexpr (sizeof(T) == 1)
    return std::conditional_t<is_signed, std::int8_t, std::uint8_t>();
  else if constexpr (sizeof(T) == 2)
    return std::conditional_t<is_signed, std::int16_t, std::uint16_t>();
  else if constexpr (sizeof(T) == 4)
    return std::conditional_t<is_signed, std::int32_t, std::uint32_t>();
  else
    return std::conditional_t<is_signed, std::int64_t, std::uint64_t>();
}

template <class T>
PointArray::Values copy_values(const T* from, std::size_t count) {
  return std::vector<decltype(fixed_type<T>())>(from, from + count);
}

PointArray to_point_array(vtkDataArray* array) {
  PointArray result;
  result.name = array->GetName() && *array->GetName() ? array->GetName() : "scalars";
  result.components = array->GetNumberOfComponents();
  const std::size_t count = array->GetNumberOfValues();
  switch (array->GetDataType()) {
    vtkTemplateMacro(result.values = copy_values(static_cast<const VTK_TT*>(array->GetVoidPointer(0)), count));
    default:
      throw Error("the array '" + result.name + "' has values of the unknown type " + array->GetDataTypeAsString());
  }
  return result;
}

/// All numeric arrays, the active scalars first; a notice about each of the others.
void take_arrays(vtkDataSet* data, std::vector<PointArray>& arrays, std::vector<std::string>& notices) {
  vtkPointData* from = data->GetPointData();
  vtkDataArray* scalars = from->GetScalars();
  for (int k = 0; k < from->GetNumberOfArrays(); ++k) {
    vtkAbstractArray* any = from->GetAbstractArray(k);
    vtkDataArray* array = vtkDataArray::SafeDownCast(any);
    const std::string name = any->GetName() ? any->GetName() : "";
    if (!array || array->GetDataType() == VTK_BIT) {
      notices.push_back("left out the point array '" + name + "': its values are of type " +
                        any->GetDataTypeAsString());
      continue;
    }
    if (array->GetNumberOfTuples() != data->GetNumberOfPoints()) {
      throw Error("the array '" + name + "' has " + std::to_string(array->GetNumberOfTuples()) + " tuples for " +
                  std::to_string(data->GetNumberOfPoints()) + " points");
    }
    arrays.insert(array == scalars ? arrays.begin() : arrays.end(), to_point_array(array));
  }
}

void require_ids(vtkIdType count, const std::string& of_what) {
  if (count <= std::numeric_limits<Id>::max()) return;
  throw Error("it has " + std::to_string(count) + " " + of_what + ", more than the " +
              std::to_string(std::numeric_limits<Id>::max()) + " that 32-bit ids can number");
}

/// `plain`: `from` holds Coordinates one after the other.
template <class Coordinate>
Dataset::Points<Coordinate> copy_points(vtkDataArray* from, bool plain) {
  const auto points = allocate<Dataset::Points<Coordinate>>("GALE::points", from->GetNumberOfTuples());
  const auto* xyz = static_cast<const Coordinate*>(plain ? from->GetVoidPointer(0) : nullptr);
  parallel_for("GALE::copy_points", Host(), points.extent(0), [&](Offset i) {
    for (int d = 0; d < 3; ++d) points(i, d) = xyz ? xyz[3 * i + d] : static_cast<Coordinate>(from->GetComponent(i, d));
  });
  return points;
}

/// What kinds of cells a grid has.
struct Census {
  vtkIdType tetrahedra = 0, lower = 0, other = 0;
  vtkIdType first_other = -1;  ///< the first cell of dimension 3 that is no tetrahedron
};

int dimension_of(int type) {
  const auto cell = vtkSmartPointer<vtkCell>::Take(vtkGenericCell::InstantiateCell(type));
  return cell ? cell->GetCellDimension() : 3;
}

std::string name_of(int type) {
  const auto cell = vtkSmartPointer<vtkCell>::Take(vtkGenericCell::InstantiateCell(type));
  return cell ? cell->GetClassName() : "of the unknown type " + std::to_string(type);
}

Census take_census(vtkDataSet* data) {
  Census census;
  std::array<int, 256> dimensions;
  dimensions.fill(-1);
  for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c) {
    const int type = data->GetCellType(c) & 255;
    int& dimension = dimensions[type];
    if (dimension < 0) dimension = dimension_of(type);
    if (type == VTK_TETRA) {
      ++census.tetrahedra;
    } else if (dimension < 3) {
      ++census.lower;
    } else if (census.other++ == 0) {
      census.first_other = c;
    }
  }
  return census;
}

/// Copies four ids per tetrahedron; returns whether all of them are ids of points.
template <class Source>
bool copy_ids(const Source* from, vtkIdType points, const Tetrahedra& to) {
  const Offset count = to.extent(0);
  const auto wrong = [&](Offset t) {
    bool any = false;
    for (int k = 0; k < 4; ++k) {
      const Source id = from[4 * t + k];
      any |= id < 0 || id >= points;
      to(t, k) = static_cast<Id>(id);
    }
    return any ? t : count;
  };
  return reduce_min("GALE::copy_tetrahedra", Host(), count, count, wrong) == count;
}

/// Where the cells are tetrahedra and nothing else, in a plain array of ids: one parallel copy. Returns whether that
/// was so.
bool copy_all_at_once(vtkCellArray* cells, vtkIdType points, const Tetrahedra& to) {
  const auto count = static_cast<vtkIdType>(to.extent(0));
  vtkDataArray* ids = cells->GetConnectivityArray();
  if (cells->GetNumberOfCells() != count || ids->GetNumberOfValues() != 4 * count || cells->GetMaxCellSize() != 4) {
    return false;
  }
  if (auto* narrow = vtkAOSDataArrayTemplate<vtkTypeInt32>::FastDownCast(ids)) {
    return copy_ids(narrow->GetPointer(0), points, to);
  }
  if (auto* wide = vtkAOSDataArrayTemplate<vtkTypeInt64>::FastDownCast(ids)) {
    return copy_ids(wide->GetPointer(0), points, to);
  }
  return false;
}

void copy_one_by_one(vtkUnstructuredGrid* grid, const Tetrahedra& to) {
  const vtkIdType points = grid->GetNumberOfPoints();
  vtkNew<vtkIdList> ids;
  std::size_t t = 0;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
    if (grid->GetCellType(c) != VTK_TETRA) continue;
    grid->GetCells()->GetCellAtId(c, ids);
    if (ids->GetNumberOfIds() != 4) {
      throw Error("the tetrahedron in cell " + std::to_string(c) + " has " + std::to_string(ids->GetNumberOfIds()) +
                  " points");
    }
    for (int k = 0; k < 4; ++k) {
      const vtkIdType id = ids->GetId(k);
      if (id < 0 || id >= points) {
        throw Error("cell " + std::to_string(c) + " names point " + std::to_string(id) + " of " +
                    std::to_string(points));
      }
      to(t, k) = static_cast<Id>(id);
    }
    ++t;
  }
}

Tetrahedra copy_tetrahedra(vtkUnstructuredGrid* grid, std::size_t count) {
  const auto tetrahedra = allocate<Tetrahedra>("GALE::tetrahedra", count);
  if (!copy_all_at_once(grid->GetCells(), grid->GetNumberOfPoints(), tetrahedra)) copy_one_by_one(grid, tetrahedra);
  return tetrahedra;
}

vtkSmartPointer<vtkUnstructuredGrid> split_cells(vtkDataSet* data, const VtkMessages& messages) {
  vtkNew<vtkDataSetTriangleFilter> filter;
  filter->SetInputData(data);
  filter->TetrahedraOnlyOn();
  filter->Update();
  messages.check(filter->GetErrorCode());
  return filter->GetOutput();
}

}  // namespace

Dataset to_mesh(vtkDataSet* data, bool tetrahedralize, const VtkMessages& messages) {
  const Census given = take_census(data);
  if (given.other > 0 && !tetrahedralize) {
    throw Error("cell " + std::to_string(given.first_other) + " is a " + name_of(data->GetCellType(given.first_other)) +
                ", not a tetrahedron (tetrahedralize splits such cells)");
  }
  vtkSmartPointer<vtkUnstructuredGrid> grid = vtkUnstructuredGrid::SafeDownCast(data);
  if (given.other > 0) grid = split_cells(data, messages);
  const vtkIdType tetrahedra = given.other > 0 ? take_census(grid).tetrahedra : given.tetrahedra;
  if (tetrahedra == 0) throw Error("it has no tetrahedra");
  if (!grid->GetPoints()) throw Error("it has no points");
  require_ids(grid->GetNumberOfPoints(), "points");
  require_ids(tetrahedra, "tetrahedra");

  Dataset mesh;
  vtkDataArray* points = grid->GetPoints()->GetData();
  const int type = points->GetDataType();
  if (type == VTK_DOUBLE) {
    mesh.points = copy_points<double>(points, true);
  } else {
    mesh.points = copy_points<float>(points, type == VTK_FLOAT);
  }
  mesh.tetrahedra = copy_tetrahedra(grid, tetrahedra);
  if (given.lower > 0) {
    mesh.notices.push_back("left out " + std::to_string(given.lower) + " cells of a dimension below 3");
  }
  take_arrays(grid, mesh.arrays, mesh.notices);
  return mesh;
}

Image to_image(vtkImageData* data) {
  Image image;
  data->GetDimensions(image.dimensions.data());
  int extent[6];
  data->GetExtent(extent);
  vtkMatrix4x4* matrix = data->GetIndexToPhysicalMatrix();  // of indices that start at the extent's
  for (int d = 0; d < 3; ++d) {
    auto& row = image.index_to_physical[d];
    row[3] = matrix->GetElement(d, 3);
    for (int k = 0; k < 3; ++k) {
      row[k] = matrix->GetElement(d, k);
      row[3] += row[k] * extent[2 * k];
    }
  }
  if (data->GetPointData()->GetNumberOfArrays() == 0 && data->GetCellData()->GetNumberOfArrays() > 0) {
    throw Error("the image has values in its cells, none at its points");
  }
  take_arrays(data, image.arrays, image.notices);
  return image;
}

}  // namespace gale::io::detail
