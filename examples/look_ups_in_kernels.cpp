// Looks up the edges of tetrahedra inside a kernel, in a program whose mesh lies in Views where its kernels run.

#include <cstdio>

#include <gale/mesh/make_mesh.hpp>
#include <gale/relations/faces.hpp>
#include <gale/relations/preconditioning.hpp>

using Space = Kokkos::DefaultExecutionSpace;

/// n x n x n points of a unit grid, and six tetrahedra about the diagonal of each of its cells.
void fill(int n, const Kokkos::View<double* [3], Space>& points, const Kokkos::View<int* [4], Space>& tetrahedra) {
  Kokkos::parallel_for(
      "points", Kokkos::RangePolicy<Space>(0, n * n * n), KOKKOS_LAMBDA(int i) {
        points(i, 0) = i % n;
        points(i, 1) = i / n % n;
        points(i, 2) = i / (n * n);
      });
  Kokkos::parallel_for(
      "tetrahedra", Kokkos::RangePolicy<Space>(0, (n - 1) * (n - 1) * (n - 1)), KOKKOS_LAMBDA(int cell) {
        const int m = n - 1, first = (cell / (m * m) * n + cell / m % m) * n + cell % m;
        const int step[3] = {1, n, n * n},
                  order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
        for (int i = 0; i < 6; ++i) {
          int vertex = first;
          tetrahedra(6 * cell + i, 0) = vertex;
          for (int corner = 0; corner < 3; ++corner)
            tetrahedra(6 * cell + i, corner + 1) = vertex += step[order[i][corner]];
        }
      });
}

/// The largest number of tetrahedra at one edge.
int largest_star(const gale::Mesh& mesh) {
  const auto simplices = mesh.simplices<gale::WorkerMemory>(gale::needs_of(gale::Relation::TE));
  const Kokkos::View<int*, Space> count("tetrahedra of each edge", mesh.known_edges());
  Kokkos::parallel_for(
      "count", Kokkos::RangePolicy<Space>(0, mesh.tetrahedra()), KOKKOS_LAMBDA(int t) {
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
  fill(n, points, tetrahedra);
  const gale::Mesh mesh = gale::make_mesh(points, tetrahedra);
  const int largest = largest_star(mesh);
  std::printf("%d vertices, %d edges, %d tetrahedra; at most %d tetrahedra at one edge\n", mesh.vertices(),
              mesh.known_edges(), mesh.tetrahedra(), largest);
  return largest == 6 ? 0 : 1;
}
