// Looks up the edges of tetrahedra inside a kernel, in a program whose mesh lies in Views where its kernels run.

#include <cstdio>

#include <gale/mesh/make_mesh.hpp>
#include <gale/relations/faces.hpp>
#include <gale/relations/preconditioning.hpp>

#include "unit_grid.hpp"

using Space = Kokkos::DefaultExecutionSpace;

/// The largest number of tetrahedra at one edge.
int largest_star(const gale::Mesh& mesh) {
  const auto simplices = mesh.simplices<gale::WorkerMemory>(gale::needs_of(gale::Relation::TE));
  const Kokkos::View<int*, Space> count("tetrahedra of each edge", mesh.known_edges());
  Kokkos::parallel_for(
      "count", Kokkos::RangePolicy<Space>(0, mesh.cells()), KOKKOS_LAMBDA(int t) {
        for (const gale::Id edge : gale::face_row<gale::Relation::TE>(simplices, t))
          Kokkos::atomic_add(&count(edge), 1);
      });
  int largest = 0;
  Kokkos::parallel_reduce(
      "largest", Kokkos::RangePolicy<Space>(0, mesh.known_edges()),
      KOKKOS_LAMBDA(int edge, int& most) { most = count(edge) > most ? count(edge) : most; },
      Kokkos::Max<int>(largest));
  return largest;
}

int main(int argc, char** argv) {
  const Kokkos::ScopeGuard kokkos(argc, argv);
  constexpr int n = 9;
  const Kokkos::View<double* [3], Space> points("points", n * n * n);
  const Kokkos::View<int* [4], Space> tetrahedra("tetrahedra", 6 * (n - 1) * (n - 1) * (n - 1));
  fill_unit_grid(n, points, tetrahedra);
  const gale::Mesh mesh = gale::make_mesh(points, tetrahedra);
  const int largest = largest_star(mesh);
  std::printf("%d vertices, %d edges, %d tetrahedra; at most %d tetrahedra at one edge\n", mesh.vertices(),
              mesh.known_edges(), mesh.cells(), largest);
  return largest == 6 ? 0 : 1;
}
