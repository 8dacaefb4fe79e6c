// Critical points and the Euler characteristic of a mesh that lies on several MPI ranks, each of which hands its part
// over as it is: mpirun -n 4 parts_of_a_simulation

#include <cstdio>
#include <vector>

#include <gale/algorithms/critical_points.hpp>
#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/distributed/distributed_mesh.hpp>
#include <gale/io/synthetic.hpp>

namespace {

/// Views of what this rank has; a simulation has its own. Global ids here are places in the whole grid.
gale::DistributedMesh distribute(const gale::Communicator& ranks, const gale::io::GridPart& part) {
  const Kokkos::View<gale::GlobalId*, gale::HostMemory> ids("ids", part.field.size()),
      cell_ids("cell_ids", part.tetrahedra.extent(0));
  for (std::size_t i = 0; i < ids.extent(0); ++i) ids(i) = part.first_vertex + gale::GlobalId(i);
  for (std::size_t t = 0; t < cell_ids.extent(0); ++t) cell_ids(t) = part.first_tetrahedron + gale::GlobalId(t);
  return gale::DistributedMesh(ranks, gale::make_part(ids, part.points, part.tetrahedra, cell_ids));
}

bool run() {
  const gale::Communicator ranks(MPI_COMM_WORLD);
  const gale::io::GridPart part = gale::io::make_grid_part(32, ranks.rank(), ranks.size());
  const gale::DistributedMesh mesh = distribute(ranks, part);
  const Kokkos::View<const float*, gale::HostMemory> field(part.field.data(), part.field.size());
  const gale::VertexOrder order(mesh, field);

  const auto points = gale::find_critical_points(order);
  const auto gradient = gale::find_discrete_gradient(order);

  if (ranks.rank() == 0) {
    std::printf("%lld tetrahedra on %d ranks: %lld minima, %lld maxima; Euler characteristic %lld\n",
                static_cast<long long>(mesh.all_cells()), ranks.size(), static_cast<long long>(points.counts[0]),
                static_cast<long long>(points.counts[3]), static_cast<long long>(gradient.euler()));
  }
  return points.counts[0] == 26 && points.counts[3] == 39 && gradient.euler() == 1;
}

}  // namespace

int main(int argc, char** argv) {
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  bool is_right = false;
  {
    const Kokkos::ScopeGuard kokkos(argc, argv);
    is_right = run();
  }
  MPI_Finalize();
  return is_right ? 0 : 1;
}
