#include <algorithm>
#include <type_traits>

#include <vtkCellArray.h>
#include <vtkDataSetTriangleFilter.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <gale/base/stop.hpp>
#include <gale/io/cells/cells.hpp>
#include <gale/io/vtk/vtk_messages.hpp>

namespace gale::io::detail {

std::vector<std::int32_t> split_cells(const PointArray::Values& points, const std::vector<std::uint8_t>& types,
                                      const std::vector<std::int64_t>& ends,
                                      const std::vector<std::int64_t>& connectivity) {
  const VtkMessages messages("its cells cannot be split");
  vtkNew<vtkPoints> xyz;
  xyz->SetDataTypeToDouble();
  std::visit(
      [&](const auto& from) {
        xyz->SetNumberOfPoints(static_cast<vtkIdType>(from.size() / 3));
        for (std::size_t i = 0; i + 2 < from.size(); i += 3)
          xyz->SetPoint(static_cast<vtkIdType>(i / 3), static_cast<double>(from[i]), static_cast<double>(from[i + 1]),
                        static_cast<double>(from[i + 2]));
      },
      points);
  std::vector<std::int32_t> result;
  constexpr std::size_t at_once = 1 << 14;  // cells: VTK is not asked to stop
  for (std::size_t first = 0; first < types.size(); first += at_once) {
    gale::detail::stop_if_asked();
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(xyz);
    std::vector<vtkIdType> ids;
    for (std::size_t c = first; c < std::min(first + at_once, types.size()); ++c) {
      ids.assign(connectivity.begin() + (c == 0 ? 0 : ends[c - 1]), connectivity.begin() + ends[c]);
      grid->InsertNextCell(types[c], static_cast<vtkIdType>(ids.size()), ids.data());
    }
    vtkNew<vtkDataSetTriangleFilter> filter;
    filter->SetInputData(grid);
    filter->TetrahedraOnlyOn();
    filter->Update();
    messages.check(filter->GetErrorCode());
    vtkUnstructuredGrid* const split = filter->GetOutput();
    for (vtkIdType c = 0; c < split->GetNumberOfCells(); ++c) {
      vtkIdType size;
      const vtkIdType* corners;
      split->GetCellPoints(c, size, corners);
      for (vtkIdType k = 0; size == 4 && k < 4; ++k) result.push_back(static_cast<std::int32_t>(corners[k]));
    }
  }
  return result;
}

}  // namespace gale::io::detail
