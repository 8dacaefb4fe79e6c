#include <gale/base/pair_key.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/radix_sort.hpp>
#include <gale/base/transfer.hpp>
#include <gale/mesh/input_numbers.hpp>

namespace gale {

namespace {

template <class Space>
using Ids = Array<Id, MemoryOf<Space>>;
template <class Space>
using Keys = Array<std::uint64_t, MemoryOf<Space>>;

/// Of the mesh, which other threads may use too: a managed View's count isn't atomic where Kokkos has Serial alone.
template <class Space>
using VertexInput = Kokkos::View<const Id*, MemoryOf<Space>, Kokkos::MemoryUnmanaged>;

KOKKOS_INLINE_FUNCTION void order(Id& a, Id& b) {
  if (b < a) {
    const Id low = b;
    b = a;
    a = low;
  }
}

/// The places that distinct keys have in order. Overwrites the keys.
template <class Space>
Ids<Space> places_of(const Space& space, const Keys<Space>& keys) {
  const auto sorted = allocate<Ids<Space>>("GALE::input_order", keys.extent(0)),
             place = allocate<Ids<Space>>("GALE::input_numbers", keys.extent(0));
  parallel_for(
      "GALE::input_order", space, keys.extent(0), KOKKOS_LAMBDA(Offset i) { sorted(i) = static_cast<Id>(i); });
  stable_sort_by_key(space, keys, sorted);
  parallel_for(
      "GALE::input_numbers", space, keys.extent(0), KOKKOS_LAMBDA(Offset i) { place(sorted(i)) = static_cast<Id>(i); });
  return place;
}

template <class Space>
Ids<Space> edge_numbers(const Space& space, const Simplices<MemoryOf<Space>>& simplices,
                        const VertexInput<Space>& input) {
  const auto keys = allocate<Keys<Space>>("GALE::edge_keys", simplices.edge_low.extent(0));
  parallel_for(
      "GALE::edge_keys", space, keys.extent(0), KOKKOS_LAMBDA(Offset e) {
        Id a = input(simplices.edge_low(e)), b = input(simplices.edge_high(e));
        order(a, b);
        keys(e) = pair_key(a, b);
      });
  return places_of(space, keys);
}

template <class Space>
Ids<Space> triangle_numbers(const Space& space, const Simplices<MemoryOf<Space>>& simplices,
                            const VertexInput<Space>& input) {
  const auto edges = edge_numbers(space, simplices, input);
  const auto keys = allocate<Keys<Space>>("GALE::triangle_keys", simplices.triangle_apex.extent(0));
  parallel_for(
      "GALE::triangle_keys", space, keys.extent(0), KOKKOS_LAMBDA(Offset f) {
        const Id edge = simplices.triangle_edge(f);
        const Id vertices[3] = {simplices.edge_low(edge), simplices.edge_high(edge), simplices.triangle_apex(f)};
        int last = 0;  // the corner whose input id is highest; the edge of the others comes first
        for (int corner = 1; corner < 3; ++corner) {
          if (input(vertices[corner]) > input(vertices[last])) last = corner;
        }
        const Id first_edge = simplices.edge_of(vertices[last == 0 ? 1 : 0], vertices[last == 2 ? 1 : 2]);
        keys(f) = pair_key(edges(first_edge), input(vertices[last]));
      });
  return places_of(space, keys);
}

template <class Space>
Array<const Id, HostMemory> numbers_in(const Space& space, const Mesh& mesh, const SimplexNeeds& needs) {
  const auto simplices = mesh.simplices<MemoryOf<Space>>(needs);
  const VertexInput<Space> input = mesh.vertex_input<MemoryOf<Space>>();
  return on_host(needs.upto == Enumeration::edges ? edge_numbers(space, simplices, input)
                                                  : triangle_numbers(space, simplices, input));
}

}  // namespace

Array<const Id, HostMemory> input_numbers(const Mesh& mesh, int dimension) {
  if (dimension == 0) return mesh.vertex_input();
  if (dimension == 3) return mesh.tetrahedron_input();
  SimplexNeeds needs;
  needs.upto = dimension == 1 ? Enumeration::edges : Enumeration::triangles;
  return in_worker_or_host_space(mesh, [&](const auto& space) { return numbers_in(space, mesh, needs); });
}

}  // namespace gale
