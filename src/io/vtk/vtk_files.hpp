#pragma once

#include <optional>
#include <string>
#include <vector>

#include <gale/export.hpp>
#include <gale/io/dataset.hpp>
#include <gale/io/write.hpp>

/// The seam between GALE and VTK. The vtk_*.cpp define these functions; where GALE is built without VTK,
/// without_vtk.cpp does.
namespace gale::io::detail {

enum class Format { vtu, vtk, vti, nifti, meta, nrrd, vtp };

/// By the extension, in either case.
GALE_EXPORT std::optional<Format> format_of(const std::string& path);

GALE_EXPORT bool has_vtk();

/// Write to `path`, whatever its extension. Arrays must fit the number of points or cells. Throw `Error` without naming
/// the file.
void write_points_with_vtk(const std::string& path, const PointSet& points);
void write_surface_with_vtk(const std::string& path, const Surface& surface);
void write_lines_with_vtk(const std::string& path, const Surface& lines);
void write_mesh_with_vtk(const std::string& path, Format format, const Dataset& mesh,
                         const std::vector<PointArray>& more);

}  // namespace gale::io::detail
