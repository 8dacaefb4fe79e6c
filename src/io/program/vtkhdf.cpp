#include <vtkHDFReader.h>
#include <vtkNew.h>

#include "readers.hpp"

namespace gale::reader {

FoundData read_vtkhdf(const std::string& path) {
  vtkNew<vtkHDFReader> reader;
  if (reader->CanReadFile(path.c_str()) == 0) return {};
  reader->SetFileName(path.c_str());
  reader->Update();
  return {vtkDataSet::SafeDownCast(reader->GetOutputDataObject(0)), ""};
}

}  // namespace gale::reader
