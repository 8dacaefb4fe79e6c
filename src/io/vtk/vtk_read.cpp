#include <algorithm>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>

#include <vtkCellData.h>
#include <vtkDataArraySelection.h>
#include <vtkDataSetReader.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkMetaImageReader.h>
#include <vtkNIFTIImageHeader.h>
#include <vtkNIFTIImageReader.h>
#include <vtkNew.h>
#include <vtkNrrdReader.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <gale/base/error.hpp>
#include <gale/io/vtk/vtk_convert.hpp>
#include <gale/io/vtk/vtk_files.hpp>
#include <gale/io/vtk/vtk_messages.hpp>

namespace gale::io::detail {
namespace {

/// VTK hands out voxels in a right-handed order, reversing the slices where the file's is not, and the transformation
/// separately.
void restore_file_order(vtkNIFTIImageReader* reader, Image& image) {
  vtkMatrix4x4* form = reader->GetSFormMatrix() ? reader->GetSFormMatrix() : reader->GetQFormMatrix();
  const double* spacing = reader->GetDataSpacing();
  for (int d = 0; form && d < 3; ++d) {
    for (int k = 0; k < 3; ++k) image.index_to_physical[d][k] = form->GetElement(d, k) * spacing[k];
    image.index_to_physical[d][3] = form->GetElement(d, 3);
  }
  if (reader->GetQFac() < 0) reverse_slices(image);
}

template <class Reader>
auto* run(Reader* reader, const std::string& path, const VtkMessages& messages) {
  reader->SetFileName(path.c_str());
  reader->Update();
  messages.check(reader->GetErrorCode());
  return reader->GetOutput();
}

/// `from` is the cell data, or the selection of what to read of it.
template <class List>
void note_cell_arrays(List* from, Dataset& mesh) {
  std::string names;
  for (int k = 0; k < from->GetNumberOfArrays(); ++k) {
    const char* name = from->GetArrayName(k);
    names += (names.empty() ? "'" : ", '") + std::string(name ? name : "") + "'";
  }
  if (!names.empty()) mesh.notices.push_back("left out the cell arrays " + names);
}

Content read_vtu(const std::string& path, bool tetrahedralize, const VtkMessages& messages) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  reader->UpdateInformation();
  messages.check(reader->GetErrorCode());
  reader->GetCellDataArraySelection()->DisableAllArrays();
  Dataset mesh = to_mesh(run(reader.Get(), path, messages), tetrahedralize, messages);
  note_cell_arrays(reader->GetCellDataArraySelection(), mesh);
  return mesh;
}

Content read_legacy(const std::string& path, bool tetrahedralize, const VtkMessages& messages) {
  vtkNew<vtkDataSetReader> reader;
  reader->ReadAllScalarsOn();
  reader->ReadAllVectorsOn();
  reader->ReadAllNormalsOn();
  reader->ReadAllTensorsOn();
  reader->ReadAllColorScalarsOn();
  reader->ReadAllTCoordsOn();
  reader->ReadAllFieldsOn();
  reader->SetFileName(path.c_str());
  const bool names_its_kind = reader->ReadOutputType() >= 0;
  messages.check(reader->GetErrorCode());
  if (!names_its_kind) messages.fail("it names no known kind of data set");
  vtkDataSet* data = run(reader.Get(), path, messages);
  if (auto* image = vtkImageData::SafeDownCast(data)) return to_image(image);
  Dataset mesh = to_mesh(data, tetrahedralize, messages);
  note_cell_arrays(data->GetCellData(), mesh);
  return mesh;
}

Content read_nifti(const std::string& path, const VtkMessages& messages) {
  vtkNew<vtkNIFTIImageReader> reader;
  Image image = to_image(run(reader.Get(), path, messages));
  restore_file_order(reader, image);
  rescale(image, reader->GetRescaleSlope(), reader->GetRescaleIntercept());
  const auto times = reader->GetNIFTIHeader()->GetDim(4);
  if (times > 1) image.notices.push_back("left out all but the first of " + std::to_string(times) + " time steps");
  return image;
}

/// MetaIO, which reads these files for VTK, reports on std::cerr, and goes on where data is missing.
class CaughtErrors {
 public:
  CaughtErrors() : before_(std::cerr.rdbuf(text_.rdbuf())) {}
  ~CaughtErrors() { std::cerr.rdbuf(before_); }
  CaughtErrors(const CaughtErrors&) = delete;
  CaughtErrors& operator=(const CaughtErrors&) = delete;

  void check(const VtkMessages& messages) {
    for (std::string line; std::getline(text_, line);) {
      if (line.compare(0, 8, "Skipping") != 0) messages.fail(line);  // fields that it doesn't know
    }
  }

 private:
  std::stringstream text_;
  std::streambuf* before_;
};

/// MetaIO runs over its buffers where a file is not "Key = value" text.
void require_meta_header(const std::string& path, const VtkMessages& messages) {
  std::ifstream file(path, std::ios::binary);
  char line[256] = "";
  file.get(line, sizeof(line));
  const std::string text = line;
  const bool printable =
      std::all_of(text.begin(), text.end(), [](char c) { return c == '\t' || c == '\r' || (c >= ' ' && c <= '~'); });
  if (!printable || text.find('=') == std::string::npos) messages.fail("its first line is not 'KEY = VALUE'");
}

Content read_meta(const std::string& path, const VtkMessages& messages) {
  require_meta_header(path, messages);
  vtkNew<vtkMetaImageReader> reader;
  CaughtErrors errors;
  reader->SetFileName(path.c_str());
  reader->Update();
  errors.check(messages);
  messages.check(reader->GetErrorCode());
  Image image = to_image(reader->GetOutput());
  rescale(image, reader->GetRescaleSlope(), reader->GetRescaleOffset());
  return image;
}

template <class Reader>
Content read_image(const std::string& path, const VtkMessages& messages) {
  vtkNew<Reader> reader;
  return to_image(run(reader.Get(), path, messages));
}

}  // namespace

bool has_vtk() { return true; }

Content read_with_vtk(const std::string& path, Format format, bool tetrahedralize) {
  const VtkMessages messages("it is damaged, incomplete or of another format");
  switch (format) {
    case Format::vtu:
      return read_vtu(path, tetrahedralize, messages);
    case Format::vtk:
      return read_legacy(path, tetrahedralize, messages);
    case Format::vti:
      return read_image<vtkXMLImageDataReader>(path, messages);
    case Format::nifti:
      return read_nifti(path, messages);
    case Format::meta:
      return read_meta(path, messages);
    case Format::nrrd:
      return read_image<vtkNrrdReader>(path, messages);
    case Format::vtp:
      break;
  }
  throw Error("it cannot be read");
}

}  // namespace gale::io::detail
