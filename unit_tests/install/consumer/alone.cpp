// The library alone, explicit structure included: that is what Kokkos-Kernels is linked for.
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include <gale/export.hpp>
#include <gale/mesh/make_mesh.hpp>
#include <gale/runtime/make_structure.hpp>
#include <gale/version.hpp>

int main(int argc, char** argv) {
  const Kokkos::ScopeGuard kokkos(argc, argv);
  const std::vector<double> points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const std::vector<std::int64_t> tetrahedra = {0, 1, 2, 3};
  const gale::Mesh mesh = gale::make_mesh(points, tetrahedra);

  int neighbours = 3;
#ifdef GALE_ENABLE_KOKKOS_KERNELS
  gale::StructureOptions options;
  options.way = gale::Way::explicit_;
  neighbours = gale::make_structure(mesh, gale::Relation::VV, options)->consumer()->row(gale::Relation::VV, 0).size();
#endif
  const std::string version = std::to_string(GALE_VERSION_MAJOR) + '.' + std::to_string(GALE_VERSION_MINOR) + '.' +
                              std::to_string(GALE_VERSION_PATCH);
  std::printf("GALE %s: vertex 0 has %d neighbours\n", gale::version, neighbours);
  return neighbours == 3 && mesh.vertices() == 4 && version == gale::version ? 0 : 1;
}
