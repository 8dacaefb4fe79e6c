#pragma once

#include <optional>
#include <string>

#include <gale/export.hpp>

namespace gale::io::detail {

enum class Format { vtu, pvtu, vtk, vti, nifti, meta, nrrd, exodus, vtkhdf, vtp };

/// By the extension, in either case.
GALE_EXPORT std::optional<Format> format_of(const std::string& path);

/// Whether files can be read: VTK has with it what that takes. Where GALE is built without VTK, vtk/without_vtk.cpp
/// stands for all of cells/, formats/ and vtk/vtk_*.cpp.
GALE_EXPORT bool has_vtk();

}  // namespace gale::io::detail
