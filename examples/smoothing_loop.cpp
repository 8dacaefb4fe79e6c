// A simulation's time loop on its own arrays: 64-bit ids and coordinates in the layout that its backend likes, where
// its kernels run. Each step smooths a field over the neighbours of each vertex, weighted by the volumes around it, and
// asks for its critical points. The mesh is encoded once; nothing of it comes to the host.

#include <cmath>
#include <cstdio>

#include <gale/algorithms/critical_points.hpp>
#include <gale/mesh/make_mesh.hpp>
#include <gale/runtime/device_sweep.hpp>
#include <gale/runtime/graph_of.hpp>
#if defined(EXAMPLE_WITH_COLORING)
#include <KokkosGraph_Distance1Color.hpp>
#include <KokkosKernels_Handle.hpp>
#endif

#include "unit_grid.hpp"

using Space = Kokkos::DefaultExecutionSpace;
using Memory = Space::memory_space;
using gale::Id;

using Points = Kokkos::View<double* [3], Kokkos::LayoutLeft, Space>;
using Tetrahedra = Kokkos::View<std::int64_t* [4], Space>;
using Values = Kokkos::View<double*, Space>;

/// A quarter of the volume of each tetrahedron of a vertex (VT). Rows have GALE's ids; the arrays are the caller's.
struct DualVolume {
  gale::Array<const Id, Memory> vertex_input, cell_input;
  Points points;
  Tetrahedra tetrahedra;
  Values volume;

  KOKKOS_FUNCTION void operator()(Id vertex, const gale::Row& star) const {
    double sum = 0;
    for (const Id t : star) sum += volume_of(cell_input(t)) / 4;
    volume(vertex_input(vertex)) = sum;
  }

  KOKKOS_FUNCTION double volume_of(Id t) const {
    double e[3][3];
    for (int k = 0; k < 3; ++k) {
      for (int d = 0; d < 3; ++d) e[k][d] = points(tetrahedra(t, k + 1), d) - points(tetrahedra(t, 0), d);
    }
    const double det = e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
                       e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                       e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
    return std::fabs(det) / 6;
  }
};

/// Half of the way to the mean of a vertex's neighbours (VV), weighted by their volumes.
struct Smooth {
  gale::Array<const Id, Memory> vertex_input;
  Values volume, before, after;

  KOKKOS_FUNCTION void operator()(Id vertex, const gale::Row& neighbours) const {
    double weights = 0, sum = 0;
    for (const Id neighbour : neighbours) {
      const Id i = vertex_input(neighbour);
      weights += volume(i);
      sum += volume(i) * before(i);
    }
    const Id i = vertex_input(vertex);
    after(i) = weights > 0 ? 0.5 * (before(i) + sum / weights) : before(i);
  }
};

double sum_of(const Values& values) {
  double sum = 0;
  Kokkos::parallel_reduce(
      "sum", Kokkos::RangePolicy<Space>(0, values.extent(0)), KOKKOS_LAMBDA(int i, double& all) { all += values(i); },
      sum);
  return sum;
}

#if defined(EXAMPLE_WITH_COLORING)
/// How many colours tell neighbours apart: a graph for Kokkos-Kernels.
int colors_of(const gale::Mesh& mesh) {
  using Handle = KokkosKernels::Experimental::KokkosKernelsHandle<gale::Offset, Id, double, Space, Memory, Memory>;
  const auto graph = gale::graph_of(Space(), mesh, gale::Relation::VV);
  Handle handle;
  handle.create_graph_coloring_handle();
  KokkosGraph::Experimental::graph_color(&handle, mesh.vertices(), mesh.vertices(), graph.offsets, graph.entries);
  const int colors = static_cast<int>(handle.get_graph_coloring_handle()->get_num_colors());
  handle.destroy_graph_coloring_handle();
  return colors;
}
#endif

int main(int argc, char** argv) {
  const Kokkos::ScopeGuard kokkos(argc, argv);
  constexpr int n = 17, steps = 4;
  const Points points("points", n * n * n);
  const Tetrahedra tetrahedra("tetrahedra", 6 * (n - 1) * (n - 1) * (n - 1));
  fill_unit_grid(n, points, tetrahedra);
  Values field("field", n * n * n), next("next", n * n * n);
  const Values volume("volume", n * n * n);
  Kokkos::parallel_for(
      "field", Kokkos::RangePolicy<Space>(0, n * n * n),
      KOKKOS_LAMBDA(int i) { field(i) = std::sin(0.9 * (i % n)) + std::sin(1.1 * (i / n % n)) * (i * 7919 % 101); });
  Kokkos::fence();

  const gale::Mesh mesh = gale::make_mesh(points, tetrahedra);
  const auto& vertex_input = mesh.vertex_input<Memory>();
  // On a host whose Kokkos has Serial alone, Space() is one thread; gale::HostThreads() in its place takes all cores.
  gale::for_each_row(Space(), mesh, gale::Relation::VT,
                     DualVolume{vertex_input, mesh.cell_input<Memory>(), points, tetrahedra, volume});
  const double whole = sum_of(volume);
  std::printf("%d vertices, volume %g\n", mesh.vertices(), whole);
#if defined(EXAMPLE_WITH_COLORING)
  std::printf("%d colours\n", colors_of(mesh));
#endif

  std::size_t first = 0, last = 0;
  for (int step = 0; step < steps; ++step) {
    const auto critical = gale::find_critical_points(Space(), gale::VertexOrder(mesh, field));
    std::printf("step %d: %zu critical points\n", step, critical.vertices.size());
    last = critical.vertices.size();
    if (step == 0) first = last;
    gale::for_each_row(Space(), mesh, gale::Relation::VV, Smooth{vertex_input, volume, field, next});
    std::swap(field, next);
  }
  return std::fabs(whole - (n - 1) * (n - 1) * (n - 1)) < 1e-6 && last < first ? 0 : 1;
}
