#include "arrays.hpp"

#include <algorithm>
#include <cstring>
#include <tuple>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>
#include <vtkTypeTraits.h>

#include <gale/base/error.hpp>

namespace gale::vtk {

namespace {

/// The integer of a size and sign that GALE's arrays have: VTK has several of 8 bytes.
template <std::size_t bytes>
using SignedOf = std::tuple_element_t<bytes == 1   ? 0
                                      : bytes == 2 ? 1
                                      : bytes == 4 ? 2
                                                   : 3,
                                      std::tuple<std::int8_t, std::int16_t, std::int32_t, std::int64_t>>;

template <class T>
auto sized(T) {
  if constexpr (std::is_floating_point_v<T>) {
    return T();
  } else if constexpr (std::is_signed_v<T>) {
    return SignedOf<sizeof(T)>();
  } else {
    return std::make_unsigned_t<SignedOf<sizeof(T)>>();
  }
}

template <class T>
io::PointArray::Values values_of(vtkDataArray* array) {
  std::vector<decltype(sized(T()))> values(static_cast<std::size_t>(array->GetNumberOfValues()));
  if (!values.empty()) std::memcpy(values.data(), array->GetVoidPointer(0), values.size() * sizeof(T));
  return values;
}

/// Cells of any size: begin[k] to begin[k + 1] - 1.
vtkSmartPointer<vtkCellArray> cells_of(const io::Surface::Cells& cells) {
  const auto ends = vtkSmartPointer<vtkTypeInt64Array>::New();
  ends->SetNumberOfValues(static_cast<vtkIdType>(cells.begin.size()));
  std::copy(cells.begin.begin(), cells.begin.end(), ends->GetPointer(0));
  const auto points = vtkSmartPointer<vtkTypeInt64Array>::New();
  points->SetNumberOfValues(static_cast<vtkIdType>(cells.points.size()));
  std::copy(cells.points.begin(), cells.points.end(), points->GetPointer(0));
  const auto all = vtkSmartPointer<vtkCellArray>::New();
  all->SetData(ends, points);
  return all;
}

}  // namespace

io::PointArray point_array(vtkDataArray* array) {
  vtkSmartPointer<vtkDataArray> plain = array;
  if (!array->HasStandardMemoryLayout()) {
    plain = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(array->GetDataType()));
    plain->DeepCopy(array);
  }
  io::PointArray result{array->GetName() != nullptr ? array->GetName() : "", array->GetNumberOfComponents(), {}};
  switch (array->GetDataType()) {
    vtkTemplateMacro(result.values = values_of<VTK_TT>(plain));
    default:
      throw Error("array '" + result.name + "' is not one of numbers");
  }
  return result;
}

vtkSmartPointer<vtkDataArray> data_array(const io::PointArray& array) {
  return std::visit(
      [&](const auto& values) {
        using T = typename std::decay_t<decltype(values)>::value_type;
        const auto copy =
            vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(vtkTypeTraits<T>::VTK_TYPE_ID));
        copy->SetName(array.name.c_str());
        copy->SetNumberOfComponents(array.components);
        copy->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / array.components);
        if (!values.empty()) std::memcpy(copy->GetVoidPointer(0), values.data(), values.size() * sizeof(T));
        return copy;
      },
      array.values);
}

vtkSmartPointer<vtkPoints> points_of(const io::Dataset::Positions& positions) {
  return std::visit(
      [](const auto& xyz) {
        using T = typename std::decay_t<decltype(xyz)>::value_type;
        const auto points = vtkSmartPointer<vtkPoints>::Take(vtkPoints::New(vtkTypeTraits<T>::VTK_TYPE_ID));
        points->SetNumberOfPoints(static_cast<vtkIdType>(xyz.extent(0)));
        if (xyz.extent(0) > 0) std::memcpy(points->GetVoidPointer(0), xyz.data(), 3 * xyz.extent(0) * sizeof(T));
        return points;
      },
      positions);
}

void add(const std::vector<io::PointArray>& arrays, vtkDataSetAttributes* to) {
  for (const io::PointArray& array : arrays) to->AddArray(data_array(array));
}

void to_poly_data(const io::PointSet& points, vtkDataSetAttributes* from, vtkPolyData* to) {
  const auto positions = points_of(points.points);
  const vtkIdType count = positions->GetNumberOfPoints();
  to->SetPoints(positions);
  io::Surface::Cells vertices;
  for (vtkIdType k = 0; k < count; ++k) {
    vertices.points.push_back(static_cast<std::int32_t>(k));
    vertices.begin.push_back(k + 1);
  }
  to->SetVerts(cells_of(vertices));
  vtkPointData* const arrays = to->GetPointData();
  add(points.arrays, arrays);
  vtkDataArray* places = arrays->GetArray("ttkVertexScalarField");
  if (places == nullptr) places = arrays->GetArray("VertexId");  // as trees have it
  const auto ids = vtkSmartPointer<vtkIdList>::New();
  ids->SetNumberOfIds(count);
  for (vtkIdType k = 0; k < count; ++k) ids->SetId(k, static_cast<vtkIdType>(places->GetTuple1(k)));
  for (int k = 0; k < from->GetNumberOfArrays(); ++k) {
    vtkAbstractArray* const array = from->GetAbstractArray(k);
    if (array->GetName() == nullptr || arrays->HasArray(array->GetName())) continue;
    const auto rows = vtkSmartPointer<vtkAbstractArray>::Take(array->NewInstance());
    rows->SetName(array->GetName());
    rows->SetNumberOfComponents(array->GetNumberOfComponents());
    rows->CopyComponentNames(array);
    rows->SetNumberOfTuples(count);
    array->GetTuples(ids, rows);
    arrays->AddArray(rows);
  }
}

void to_poly_data(const io::Surface& surface, vtkPolyData* to) {
  to->SetPoints(points_of(surface.points));
  if (surface.lines.begin.size() > 1) to->SetLines(cells_of(surface.lines));
  if (surface.polygons.begin.size() > 1) to->SetPolys(cells_of(surface.polygons));
  add(surface.point_arrays, to->GetPointData());
  add(surface.cell_arrays, to->GetCellData());
}

}  // namespace gale::vtk
