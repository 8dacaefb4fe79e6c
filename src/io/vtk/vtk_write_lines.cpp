#include <cerrno>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkTypeTraits.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <gale/io/vtk/vtk_files.hpp>
#include <gale/io/vtk/vtk_messages.hpp>

namespace gale::io::detail {
namespace {

/// VTK's view of values that stay where they are and outlive it.
template <class T>
vtkSmartPointer<vtkDataArray> wrap(const T* values, std::size_t count, int components) {
  auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(vtkTypeTraits<T>::VTK_TYPE_ID));
  array->SetNumberOfComponents(components);
  array->SetVoidArray(const_cast<T*>(values), static_cast<vtkIdType>(count), 1);
  return array;
}

void add_arrays(vtkDataSetAttributes* to, const std::vector<PointArray>& arrays) {
  for (const PointArray& array : arrays) {
    const auto wrapped = std::visit(
        [&](const auto& values) { return wrap(values.data(), values.size(), array.components); }, array.values);
    wrapped->SetName(array.name.c_str());
    to->AddArray(wrapped);
  }
}

}  // namespace

void write_lines_with_vtk(const std::string& path, const Surface& lines) {
  const VtkMessages messages("VTK gave up");
  vtkNew<vtkPoints> points;
  std::visit([&](const auto& xyz) { points->SetData(wrap(xyz.data(), xyz.extent(0) * 3, 3)); }, lines.points);
  vtkNew<vtkCellArray> cells;
  for (std::size_t i = 0; i + 1 < lines.lines.begin.size(); ++i) {
    cells->InsertNextCell(static_cast<int>(lines.lines.begin[i + 1] - lines.lines.begin[i]));
    for (auto k = lines.lines.begin[i]; k < lines.lines.begin[i + 1]; ++k)
      cells->InsertCellPoint(lines.lines.points[k]);
  }
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  grid->SetCells(VTK_LINE, cells);
  add_arrays(grid->GetPointData(), lines.point_arrays);
  add_arrays(grid->GetCellData(), lines.cell_arrays);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressionLevel(1);
  writer->SetFileName(path.c_str());
  writer->SetInputData(grid);
  messages.check(vtkErrorCode::NoError);
  errno = 0;
  const int written = writer->Write();
  messages.check_written(written != 0, writer->GetErrorCode());
}

}  // namespace gale::io::detail
