#include <algorithm>
#include <cctype>
#include <utility>

#include <gale/io/formats.hpp>

namespace gale::io::detail {

std::optional<Format> format_of(const std::string& path) {
  static const std::pair<const char*, Format> formats[] = {
      {".vtu", Format::vtu},    {".pvtu", Format::pvtu},     {".vtk", Format::vtk},    {".vti", Format::vti},
      {".nii", Format::nifti},  {".nii.gz", Format::nifti},  {".mha", Format::meta},   {".mhd", Format::meta},
      {".nrrd", Format::nrrd},  {".e", Format::exodus},      {".ex2", Format::exodus}, {".exo", Format::exodus},
      {".hdf", Format::vtkhdf}, {".vtkhdf", Format::vtkhdf}, {".vtp", Format::vtp}};
  std::string lower = path;
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  for (const auto& [extension, format] : formats) {
    const std::string ending = extension;
    if (lower.size() > ending.size() && lower.compare(lower.size() - ending.size(), ending.size(), ending) == 0)
      return format;
  }
  return std::nullopt;
}

}  // namespace gale::io::detail
