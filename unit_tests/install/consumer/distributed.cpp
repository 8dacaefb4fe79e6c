// The library for several ranks.
#include <cstdint>
#include <cstdio>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/distributed/distributed_mesh.hpp>
#include <gale/runtime/make_structure.hpp>

int main(int argc, char** argv) {
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  gale::GlobalId euler = 0;
  {
    const Kokkos::ScopeGuard kokkos(argc, argv);
    const double points[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const std::int64_t ids[4] = {7, 2, 40, 3}, tetrahedra[1][4] = {{40, 2, 7, 3}};
    const float values[4] = {2, 1, 4, 3};
    using Host = Kokkos::HostSpace;
    const auto part =
        gale::make_part(Kokkos::View<const std::int64_t*, Host>(ids, 4),
                        Kokkos::View<const double* [3], Kokkos::LayoutRight, Host>(&points[0][0], 4),
                        Kokkos::View<const std::int64_t* [4], Kokkos::LayoutRight, Host>(&tetrahedra[0][0], 1));
    const gale::DistributedMesh mesh(gale::Communicator(MPI_COMM_WORLD), part);
    const auto structure = gale::make_structure(mesh, gale::discrete_gradient_relations);
    const gale::VertexOrder order(mesh, Kokkos::View<const float*, Host>(values, 4));
    euler = gale::find_discrete_gradient(*structure, order).euler();
  }
  MPI_Finalize();
  std::printf("a tetrahedron has the Euler characteristic %d\n", static_cast<int>(euler));
  return euler == 1 ? 0 : 1;
}
