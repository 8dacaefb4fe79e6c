// Reads rows of relations in a program that has nothing but std::vectors.

#include <cstdint>
#include <cstdio>
#include <vector>

#include <gale/mesh/make_mesh.hpp>
#include <gale/runtime/make_structure.hpp>

int main(int argc, char** argv) {
  const Kokkos::ScopeGuard kokkos(argc, argv);

  // An octahedron about vertex 0: eight tetrahedra.
  const std::vector<double> points = {0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
  std::vector<std::int64_t> tetrahedra;
  for (const std::int64_t x : {1, 2}) {
    for (const std::int64_t y : {3, 4}) {
      for (const std::int64_t z : {5, 6}) tetrahedra.insert(tetrahedra.end(), {0, x, y, z});
    }
  }

  const gale::Mesh mesh = gale::make_mesh(points, tetrahedra);
  const auto runtime = gale::make_structure(mesh, gale::Relation::VV | gale::Relation::VE | gale::Relation::EF);
  const auto consumer = runtime->consumer();
  const gale::Id center = mesh.vertex_internal()(0);  // GALE numbers the vertices anew; vertex_input() leads back
  std::printf("vertex 0 is beside the vertices");
  for (const gale::Id neighbour : consumer->row(gale::Relation::VV, center))
    std::printf(" %d", mesh.vertex_input()(neighbour));
  std::printf("\nand its edges have");
  int incidences = 0;
  for (const gale::Id edge : consumer->row(gale::Relation::VE, center)) {
    const gale::Row triangles = consumer->row(gale::Relation::EF, edge);
    std::printf(" %d", triangles.size());
    incidences += triangles.size();
  }
  std::printf(" triangles\n");
  return incidences == 24 ? 0 : 1;
}
