#include <algorithm>
#include <filesystem>

#include <gale/io/bytes/text.hpp>
#include <gale/io/formats.hpp>
#include <gale/io/writers/writers.hpp>

namespace gale::io {
namespace detail {

// Defined in formats/, a file each.
Reader read_vtu, read_pvtu, read_legacy_vtk, read_vti, read_nifti, read_meta_image, read_nrrd, read_exodus, read_vtkhdf,
    read_vts, read_vtr, read_vtp, read_stl, read_ply, read_obj, read_off, read_pvd, read_file_series;
StepsReader steps_of_exodus, steps_of_vtkhdf, steps_of_pvd, steps_of_file_series;

}  // namespace detail

namespace {

std::string as_pvd(const std::string& path) { return std::filesystem::path(path).replace_extension(".pvd").string(); }

std::string as_series(const std::string& path) { return path + ".series"; }

}  // namespace

const std::vector<Format>& formats() {
  using namespace detail;
  constexpr ContentWriter* none = nullptr;
  static const std::vector<Format> all = {
      {"VTK XML mesh", ".vtu", Input::mesh, "an unstructured grid, in one piece or several", read_vtu, nullptr,
       written_meshes | written_lines | written_pieces, write_xml, as_pvd},
      {"pieces of VTK XML meshes", ".pvtu", Input::mesh,
       "the `.vtu` that it names, in its folder or below, as one mesh", read_pvtu, nullptr, written_pieces, none,
       as_pvd, ".vtu"},
      {"legacy VTK", ".vtk", Input::mesh,
       "an unstructured, structured or rectilinear grid, or a surface; structured points are a volume", read_legacy_vtk,
       nullptr, written_meshes, write_legacy_vtk},
      {"VTK XML surface", ".vtp", Input::mesh, "polygons and strips, in one piece or several", read_vtp, nullptr,
       written_points | written_surfaces | written_triangles | written_arrows, write_xml, as_pvd},
      {"VTK XML structured grid", ".vts", Input::mesh, "a mesh of hexahedra or quads, in one piece or several",
       read_vts},
      {"VTK XML rectilinear grid", ".vtr", Input::mesh, "a mesh of voxels or pixels, in one piece or several",
       read_vtr},
      {"VTK XML image", ".vti", Input::volume, "an image, in one piece or several", read_vti},
      {"NIfTI", ".nii .nii.gz", Input::volume, "versions 1 and 2, the first time, placed by its sform, else its qform",
       read_nifti},
      {"MetaImage", ".mha .mhd", Input::volume, "values in the file or in others, raw, deflated or text",
       read_meta_image},
      {"NRRD", ".nrrd", Input::volume,
       "values in the file or in others, raw, gzip or text; the first of several volumes", read_nrrd},
      {"Exodus II", ".e .ex2 .exo", Input::mesh,
       "NetCDF's classic forms and NetCDF-4: all blocks of elements, nodal variables; its times are a series",
       read_exodus, steps_of_exodus},
      {"VTKHDF", ".hdf .vtkhdf", Input::mesh, "versions 1 and 2, a mesh or an image; its times are a series",
       read_vtkhdf, steps_of_vtkhdf,
       written_points | written_surfaces | written_lines | written_meshes | written_triangles, write_vtkhdf, as_series},
      {"STL", ".stl", Input::mesh, "facets, ASCII or binary; their corners are one where they are equal", read_stl},
      {"PLY", ".ply", Input::mesh, "faces and strips, ASCII or binary, and the numbers that vertices have", read_ply},
      {"Wavefront OBJ", ".obj", Input::mesh, "vertices and faces", read_obj},
      {"OFF", ".off", Input::mesh, "vertices and faces, as text", read_off},
      {"ParaView's data", ".pvd", Input::series, "the files that it names, in its folder or below, a time each",
       read_pvd, steps_of_pvd, written_series, write_xml_series},
      {"series of files", ".series", Input::series, "likewise: `.vtu.series` and its like, which are JSON",
       read_file_series, steps_of_file_series, written_series, write_file_series},
      {"pieces of VTK XML surfaces", ".pvtp", Input::none, "", nullptr, nullptr,
       written_points | written_surfaces | written_arrows, none, as_pvd, ".vtp"},
      {"comma-separated values", ".csv", Input::none, "", nullptr, nullptr, written_tables, to_csv},
      {"NumPy's archive", ".npz", Input::none, "", nullptr, nullptr, written_tables, to_npz},
      {"PNG", ".png", Input::none, "", nullptr, nullptr, written_pictures}};
  return all;
}

const Format* format_of(const std::string& path) {
  for (const Format& format : formats()) {
    for (const std::string& ending : detail::words_of(format.extensions)) {
      if (detail::has_extension(path, ending)) return &format;
    }
  }
  return nullptr;
}

std::string extensions_of(const std::function<bool(const Format& format)>& is_meant) {
  std::string all;
  for (const Format& format : formats()) {
    if (is_meant(format)) all += (all.empty() ? "" : " ") + std::string(format.extensions);
  }
  return all;
}

std::string extensions_of(Input input) {
  return extensions_of([input](const Format& format) { return format.input == input; });
}

std::vector<std::string> extensions_written(unsigned written, bool on_ranks) {
  std::vector<std::string> all;
  for (unsigned bit = 1; bit <= written; bit *= 2) {
    for (const Format& format : formats()) {
      const std::string extension = detail::words_of(format.extensions).back();
      if ((format.written & written & bit) != 0 && (format.pieces != nullptr) == on_ranks &&
          std::find(all.begin(), all.end(), extension) == all.end())
        all.push_back(extension);
    }
  }
  return on_ranks && all.empty() ? extensions_written(written) : all;
}

}  // namespace gale::io
