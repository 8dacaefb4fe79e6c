#include <gale/base/error.hpp>
#include <gale/io/formats/readers.hpp>

namespace gale::io::detail {

bool has_vtk() { return true; }

Content read_content(const InputFile& file, Format format, const ReadOptions& options) {
  switch (format) {
    case Format::vtu:
      return read_vtu(file, options);
    case Format::vtk:
      return read_legacy_vtk(file, options);
    case Format::vti:
      return read_vti(file, options);
    case Format::nifti:
      return read_nifti(file, options);
    case Format::meta:
      return read_meta_image(file, options);
    case Format::nrrd:
      return read_nrrd(file, options);
    case Format::pvtu:
      return read_pvtu(file, options);
    case Format::exodus:
      return read_exodus(file, options);
    case Format::vtkhdf:
      return read_vtkhdf(file, options);
    case Format::vtp:
      break;
  }
  throw Error("it cannot be read");
}

}  // namespace gale::io::detail
