// The libraries beside the first: files and fields.
#include <cstdio>

#include <gale/base/error.hpp>
#include <gale/io/synthetic.hpp>
#include <gale/io/write.hpp>
#include <gale/mesh/make_mesh.hpp>
#include <gale/outputs/field.hpp>

int main(int argc, char** argv) {
  const Kokkos::ScopeGuard kokkos(argc, argv);
  const gale::io::Dataset grid = gale::io::make_grid(3);
  try {
    gale::io::write_mesh("grid.vtu", grid);
  } catch (const gale::Error& error) {  // this GALE has no VTK
    std::printf("%s\n", error.what());
  }
  const gale::io::PointArray field = gale::outputs::select_field(grid, "");
  std::printf("grid:3 has the field %s\n", field.name.c_str());
  return field.name == "field" ? 0 : 1;
}
