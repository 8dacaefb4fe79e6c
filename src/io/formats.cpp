#include <gale/io/bytes/text.hpp>
#include <gale/io/formats.hpp>

namespace gale::io {
namespace detail {

// Defined in formats/, a file each.
Reader read_vtu, read_pvtu, read_legacy_vtk, read_vti, read_nifti, read_meta_image, read_nrrd, read_exodus, read_vtkhdf,
    read_vts, read_vtr, read_vtp, read_stl, read_ply, read_obj, read_off, read_pvd, read_file_series;
StepsReader steps_of_exodus, steps_of_vtkhdf, steps_of_pvd, steps_of_file_series;

}  // namespace detail

const std::vector<Format>& formats() {
  using namespace detail;
  static const std::vector<Format> all = {
      {"VTK XML mesh", ".vtu", Input::mesh, written_meshes | written_lines | written_pieces | written_steps, false,
       "an unstructured grid, in one piece or several", read_vtu},
      {"pieces of VTK XML meshes", ".pvtu", Input::mesh, written_pieces | written_steps, true,
       "the `.vtu` that it names, in its folder or below, as one mesh", read_pvtu},
      {"legacy VTK", ".vtk", Input::mesh, written_meshes, false,
       "an unstructured, structured or rectilinear grid, or a surface; structured points are a volume",
       read_legacy_vtk},
      {"VTK XML surface", ".vtp", Input::mesh, written_points | written_surfaces | written_triangles | written_steps,
       false, "polygons and strips, in one piece or several", read_vtp},
      {"VTK XML structured grid", ".vts", Input::mesh, 0, false,
       "a mesh of hexahedra or quads, in one piece or several", read_vts},
      {"VTK XML rectilinear grid", ".vtr", Input::mesh, 0, false, "a mesh of voxels or pixels, in one piece or several",
       read_vtr},
      {"VTK XML image", ".vti", Input::volume, 0, false, "an image, in one piece or several", read_vti},
      {"NIfTI", ".nii .nii.gz", Input::volume, 0, false,
       "versions 1 and 2, the first time, placed by its sform, else its qform", read_nifti},
      {"MetaImage", ".mha .mhd", Input::volume, 0, false, "values in the file or in others, raw, deflated or text",
       read_meta_image},
      {"NRRD", ".nrrd", Input::volume, 0, false,
       "values in the file or in others, raw, gzip or text; the first of several volumes", read_nrrd},
      {"Exodus II", ".e .ex2 .exo", Input::mesh, 0, false,
       "NetCDF's classic forms and NetCDF-4: all blocks of elements, nodal variables; its times are a series",
       read_exodus, steps_of_exodus},
      {"VTKHDF", ".hdf .vtkhdf", Input::mesh,
       written_points | written_surfaces | written_lines | written_meshes | written_triangles, false,
       "versions 1 and 2, a mesh or an image; its times are a series", read_vtkhdf, steps_of_vtkhdf},
      {"STL", ".stl", Input::mesh, 0, false, "facets, ASCII or binary; their corners are one where they are equal",
       read_stl},
      {"PLY", ".ply", Input::mesh, 0, false, "faces and strips, ASCII or binary, and the numbers that vertices have",
       read_ply},
      {"Wavefront OBJ", ".obj", Input::mesh, 0, false, "vertices and faces", read_obj},
      {"OFF", ".off", Input::mesh, 0, false, "vertices and faces, as text", read_off},
      {"ParaView's data", ".pvd", Input::series, written_series, true,
       "the files that it names, in its folder or below, a time each", read_pvd, steps_of_pvd},
      {"series of files", ".series", Input::series, written_series, true,
       "likewise: `.vtu.series` and its like, which are JSON", read_file_series, steps_of_file_series},
      {"pieces of VTK XML surfaces", ".pvtp", Input::none, written_points | written_surfaces | written_steps, true, "",
       nullptr}};
  return all;
}

const Format* format_of(const std::string& path) {
  const std::string lower = detail::lower_case(path);
  for (const Format& format : formats()) {
    for (const std::string& ending : detail::words_of(format.extensions)) {
      if (lower.size() > ending.size() && lower.compare(lower.size() - ending.size(), ending.size(), ending) == 0)
        return &format;
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

}  // namespace gale::io
