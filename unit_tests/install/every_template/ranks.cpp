#include <gale/algorithms/critical_points.hpp>
#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/distributed/distributed_mesh.hpp>

#include "parts.hpp"

namespace every_template {

namespace {

/// A mesh on one rank of Views with such types, and the orders of fields on it.
template <class Coordinate, class Index, class GlobalIndex, class Memory>
void distribute(const gale::Communicator& ranks) {
  const Kokkos::View<GlobalIndex**, Memory> ids("ids", vertices, 1), cell_ids("cell_ids", tetrahedra, 1);
  const Kokkos::View<Coordinate* [3], Memory> p("points", vertices);
  const Kokkos::View<Index* [4], Memory> t("tetrahedra", tetrahedra);
  const int numbers[vertices][1] = {{0}, {1}, {2}, {3}, {4}};
  fill(ids, numbers);
  fill(cell_ids, numbers);
  fill(p, points);
  fill(t, corners);
  const auto vertex_ids = Kokkos::subview(ids, Kokkos::ALL(), 0);
  const auto part = gale::make_part(vertex_ids, p, t);
  const auto with_ids = gale::make_part(vertex_ids, p, t, Kokkos::subview(cell_ids, Kokkos::ALL(), 0));
  expect(with_ids.cell_ids.extent(0) == tetrahedra, "ids of cells");
  const gale::MeshPart<typename decltype(part.cells)::non_const_value_type>& same = part;
  const gale::DistributedMesh mesh(ranks, same);
  expect(mesh.all_vertices() == vertices, "a mesh on ranks");
  const gale::HostPoints& kept = same.points;
  expect(kept.visit([](const auto& rows) { return rows.extent(0); }) == vertices, "points of ranks");
}

template <class Value>
void order(const gale::DistributedMesh& mesh) {
  const Value values[vertices] = {3, 1, 4, 1, 5};
  const Kokkos::View<const Value*, gale::HostMemory, Kokkos::MemoryUnmanaged> host(values, vertices);
  const gale::VertexOrder order(mesh, host);
  const auto worker = Kokkos::create_mirror_view_and_copy(gale::WorkerMemory(), host);
  expect(gale::VertexOrder(mesh, worker).keys()[0] == order.keys()[0], "keys of ranks");
}

template <class... Values>
void order_each(const gale::DistributedMesh& mesh) {
  (order<Values>(mesh), ...);
}

}  // namespace

void use_ranks() {
  const gale::Communicator ranks(MPI_COMM_SELF);
  distribute<double, std::int64_t, std::int64_t, gale::HostMemory>(ranks);
  distribute<float, int, int, gale::HostMemory>(ranks);
  distribute<double, int, unsigned, gale::WorkerMemory>(ranks);
  distribute<float, std::int64_t, std::int64_t, gale::WorkerMemory>(ranks);

  const Kokkos::View<gale::GlobalId*, gale::HostMemory> ids("ids", vertices);
  for (int v = 0; v < vertices; ++v) ids(v) = v;
  const Kokkos::View<double* [3], gale::HostMemory> p("points", vertices);
  const Kokkos::View<int* [4], gale::HostMemory> t("tetrahedra", tetrahedra);
  const gale::DistributedMesh mesh(ranks, gale::make_part(ids, fill(p, points), fill(t, corners)));
  order_each<char, signed char, unsigned char, short, unsigned short, int, unsigned, long, unsigned long, long long,
             unsigned long long, float, double>(mesh);

  const Kokkos::View<double*, gale::HostMemory> field("field", vertices);
  const gale::VertexOrder order(mesh, field);
  expect(gale::find_critical_points(gale::WorkerSpace(), order).counts[0] == 1, "one minimum on ranks");
  expect(gale::find_discrete_gradient(gale::WorkerSpace(), order).euler() == 1, "the Euler characteristic on ranks");
}

}  // namespace every_template
