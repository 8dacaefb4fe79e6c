// The library of files by itself: writes a mesh and its points, and reads the mesh again.
#include <cstdio>
#include <string>
#include <variant>

#include <gale/base/error.hpp>
#include <gale/io/formats.hpp>
#include <gale/io/read.hpp>
#include <gale/io/synthetic.hpp>
#include <gale/io/write.hpp>

int main(int argc, char** argv) {
  const Kokkos::ScopeGuard kokkos(argc, argv);
  const gale::io::Dataset grid = gale::io::make_grid(4);
  gale::io::write_points("files_points.vtp", {grid.points, grid.arrays});
  for (const std::string path : {"files.vtu", "files.vtk"}) {
    gale::io::write_mesh(path, grid);
    try {
      const gale::io::Dataset read = gale::io::read(path);
      const bool is_same = read.tetrahedra.extent(0) == grid.tetrahedra.extent(0) && read.arrays.size() == 1 &&
                           read.arrays[0].name == "field" && read.arrays[0].values == grid.arrays[0].values;
      std::printf("%s, a %s, has %zu tetrahedra\n", path.c_str(), gale::io::format_of(path)->name,
                  static_cast<std::size_t>(read.tetrahedra.extent(0)));
      if (!is_same) return 1;
    } catch (const gale::Error& error) {  // right where this GALE has no VTK
      std::printf("%s\n", error.what());
      if (std::string(error.what()).find("built without VTK") == std::string::npos) return 1;
    }
  }
  return 0;
}
