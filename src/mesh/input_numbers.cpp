#include <gale/base/pair_key.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/radix_sort.hpp>
#include <gale/base/transfer.hpp>
#include <gale/mesh/input_numbers.hpp>

namespace gale {

namespace {

using Ids = Array<Id, WorkerMemory>;
using Keys = Array<std::uint64_t, WorkerMemory>;

/// Of the mesh', which other threads may use too: a managed View's count isn't atomic where Kokkos has Serial alone.
using VertexInput = Kokkos::View<const Id*, WorkerMemory, Kokkos::MemoryUnmanaged>;

KOKKOS_INLINE_FUNCTION void order(Id& a, Id& b) {
  if (b < a) {
    const Id low = b;
    b = a;
    a = low;
  }
}

/// The places that distinct keys have in order. Overwrites the keys.
Ids places_of(const Keys& keys) {
  const auto sorted = allocate<Ids>("GALE::input_order", keys.extent(0)),
             place = allocate<Ids>("GALE::input_numbers", keys.extent(0));
  const WorkerSpace space;
  parallel_for(
      "GALE::input_order", space, keys.extent(0), KOKKOS_LAMBDA(Offset i) { sorted(i) = static_cast<Id>(i); });
  stable_sort_by_key(keys, sorted);
  parallel_for(
      "GALE::input_numbers", space, keys.extent(0), KOKKOS_LAMBDA(Offset i) { place(sorted(i)) = static_cast<Id>(i); });
  return place;
}

Ids edge_numbers(const Simplices<WorkerMemory>& simplices, const VertexInput& input) {
  const auto keys = allocate<Keys>("GALE::edge_keys", simplices.edge_low.extent(0));
  parallel_for(
      "GALE::edge_keys", WorkerSpace(), keys.extent(0), KOKKOS_LAMBDA(Offset e) {
        Id a = input(simplices.edge_low(e)), b = input(simplices.edge_high(e));
        order(a, b);
        keys(e) = pair_key(a, b);
      });
  return places_of(keys);
}

Ids triangle_numbers(const Simplices<WorkerMemory>& simplices, const VertexInput& input) {
  const auto edges = edge_numbers(simplices, input);
  const auto keys = allocate<Keys>("GALE::triangle_keys", simplices.triangle_apex.extent(0));
  parallel_for(
      "GALE::triangle_keys", WorkerSpace(), keys.extent(0), KOKKOS_LAMBDA(Offset f) {
        const Id edge = simplices.triangle_edge(f);
        const Id vertices[3] = {simplices.edge_low(edge), simplices.edge_high(edge), simplices.triangle_apex(f)};
        int last = 0;  // the corner whose input id is highest; the edge of the others comes first
        for (int corner = 1; corner < 3; ++corner) {
          if (input(vertices[corner]) > input(vertices[last])) last = corner;
        }
        const Id first_edge = simplices.edge_of(vertices[last == 0 ? 1 : 0], vertices[last == 2 ? 1 : 2]);
        keys(f) = pair_key(edges(first_edge), input(vertices[last]));
      });
  return places_of(keys);
}

}  // namespace

Array<const Id, HostMemory> input_numbers(const Mesh& mesh, int dimension) {
  if (dimension == 0) return mesh.vertex_input();
  if (dimension == 3) return mesh.tetrahedron_input();
  SimplexNeeds needs;
  needs.upto = dimension == 1 ? Enumeration::edges : Enumeration::triangles;
  const auto simplices = mesh.simplices_on_worker(needs);
  const VertexInput input = mesh.vertex_input_on_worker();
  return on_host(dimension == 1 ? edge_numbers(simplices, input) : triangle_numbers(simplices, input));
}

}  // namespace gale
