#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <limits>
#include <locale>
#include <numeric>
#include <string>
#include <variant>
#include <vector>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkErrorCode.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTypeTraits.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <gale/base/error.hpp>
#include <gale/base/types.hpp>
#include <gale/io/vtk/vtk_files.hpp>
#include <gale/io/vtk/vtk_messages.hpp>

namespace gale::io::detail {
namespace {

/// VTK's view of `count` values that stay where they are and outlive it. VTK only writes them out, so const holds.
template <class T>
vtkSmartPointer<vtkDataArray> wrap(const T* values, std::size_t count, int components = 1) {
  auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(vtkTypeTraits<T>::VTK_TYPE_ID));
  array->SetNumberOfComponents(components);
  array->SetVoidArray(const_cast<T*>(values), static_cast<vtkIdType>(count), 1);
  return array;
}

vtkSmartPointer<vtkPoints> wrap_points(const std::variant<Dataset::Points<float>, Dataset::Points<double>>& points) {
  auto result = vtkSmartPointer<vtkPoints>::New();
  std::visit([&](const auto& xyz) { result->SetData(wrap(xyz.data(), xyz.extent(0) * 3, 3)); }, points);
  return result;
}

void add_arrays(vtkDataSetAttributes* to, const std::vector<PointArray>& arrays) {
  for (const PointArray& array : arrays) {
    const auto add = [&](const auto& values) {
      const auto wrapped = wrap(values.data(), values.size(), array.components);
      wrapped->SetName(array.name.c_str());
      to->AddArray(wrapped);
    };
    std::visit(add, array.values);
  }
}

/// An array of VTK's own, with value(k) at k.
template <class Integer, class Value>
vtkSmartPointer<vtkDataArray> make_integers(std::size_t count, const Value& value) {
  auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(vtkTypeTraits<Integer>::VTK_TYPE_ID));
  array->SetNumberOfValues(static_cast<vtkIdType>(count));
  auto* values = static_cast<Integer*>(array->GetVoidPointer(0));
  for (std::size_t k = 0; k < count; ++k) values[k] = static_cast<Integer>(value(k));
  return array;
}

/// `count` cells whose points begin at `begin(cell)` of `ids`, which stay where they are unless their number takes 64
/// bits.
template <class Begin>
vtkSmartPointer<vtkCellArray> make_cells(const Id* ids, std::size_t count, const Begin& begin) {
  const auto size = static_cast<std::size_t>(begin(count));
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  if (size <= static_cast<std::size_t>(std::numeric_limits<Id>::max())) {
    cells->SetData(make_integers<Id>(count + 1, begin), wrap(ids, size));
  } else {
    const auto wide = make_integers<std::int64_t>(size, [ids](std::size_t k) { return ids[k]; });
    cells->SetData(make_integers<std::int64_t>(count + 1, begin), wide);
  }
  return cells;
}

/// Cells of `size` points each.
vtkSmartPointer<vtkCellArray> make_cells(const Id* ids, std::size_t count, int size) {
  return make_cells(ids, count, [size](std::size_t cell) { return cell * size; });
}

vtkSmartPointer<vtkCellArray> make_cells(const Surface::Cells& cells) {
  return make_cells(cells.points.data(), cells.begin.size() - 1, [&](std::size_t cell) { return cells.begin[cell]; });
}

/// Runs `writer`, and throws `Error` if it did not write all of its file.
template <class Writer>
void run(Writer* writer, const std::string& path, vtkDataObject* data, const VtkMessages& messages) {
  writer->SetFileName(path.c_str());
  writer->SetInputData(data);
  errno = 0;
  const int written = writer->Write();
  const int failure = errno;
  const bool is_there = access(path.c_str(), F_OK) == 0;  // VTK removes what it couldn't write, not always saying so
  errno = failure;
  messages.check_written(written != 0 && is_there, writer->GetErrorCode());
}

template <class XmlWriter>
void write_xml(const std::string& path, vtkDataObject* data, const VtkMessages& messages) {
  vtkNew<XmlWriter> writer;
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressionLevel(1);  // zlib's; its usual 5 takes seven times as long for six percent less
  run(writer.Get(), path, data, messages);
}

/// VTK's legacy writers delete their stream without asking whether its last bytes reached the file: this one does.
class LegacyWriter : public vtkUnstructuredGridWriter {
 public:
  static LegacyWriter* New();
  vtkTypeMacro(LegacyWriter, vtkUnstructuredGridWriter);

  ostream* OpenVTKFile() override { return new Stream(this); }

 private:
  struct Stream : std::ofstream {
    explicit Stream(LegacyWriter* w) : std::ofstream(w->GetFileName(), std::ios::binary), writer(w) {
      imbue(std::locale::classic());
    }
    ~Stream() override {
      if (!flush()) writer->SetErrorCode(vtkErrorCode::OutOfDiskSpaceError);
    }
    LegacyWriter* writer;
  };
};

vtkStandardNewMacro(LegacyWriter);

}  // namespace

void write_points_with_vtk(const std::string& path, const PointSet& points) {
  const VtkMessages messages("VTK cannot write it");
  const std::size_t count = std::visit([](const auto& p) { return p.extent(0); }, points.points);
  std::vector<Id> ids(count);
  std::iota(ids.begin(), ids.end(), 0);
  vtkNew<vtkPolyData> data;
  data->SetPoints(wrap_points(points.points));
  data->SetVerts(make_cells(ids.data(), count, 1));
  add_arrays(data->GetPointData(), points.arrays);
  write_xml<vtkXMLPolyDataWriter>(path, data, messages);
}

void write_surface_with_vtk(const std::string& path, const Surface& surface) {
  const VtkMessages messages("VTK cannot write it");
  vtkNew<vtkPolyData> data;
  data->SetPoints(wrap_points(surface.points));
  data->SetLines(make_cells(surface.lines));
  data->SetPolys(make_cells(surface.polygons));
  add_arrays(data->GetPointData(), surface.point_arrays);
  add_arrays(data->GetCellData(), surface.cell_arrays);
  write_xml<vtkXMLPolyDataWriter>(path, data, messages);
}

void write_mesh_with_vtk(const std::string& path, Format format, const Dataset& mesh,
                         const std::vector<PointArray>& more) {
  const VtkMessages messages("VTK cannot write it");
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(wrap_points(mesh.points));
  grid->SetCells(VTK_TETRA, make_cells(mesh.tetrahedra.data(), mesh.tetrahedra.extent(0), 4));
  add_arrays(grid->GetPointData(), mesh.arrays);
  add_arrays(grid->GetPointData(), more);
  if (format == Format::vtu) {
    write_xml<vtkXMLUnstructuredGridWriter>(path, grid, messages);
  } else {
    vtkNew<LegacyWriter> writer;
    writer->SetFileTypeToBinary();
    run(writer.Get(), path, grid, messages);
  }
}

}  // namespace gale::io::detail
