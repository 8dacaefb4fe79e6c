#include <gale/base/group_by.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort.hpp>
#include <gale/base/transfer.hpp>
#include <gale/mesh/numbering/number.hpp>

namespace gale {

namespace detail {

namespace {

template <class Space>
using SpaceIds = Array<Id, MemoryOf<Space>>;

/// The places that simplices have in order, by two numbers each: `first`, of which there are `firsts`, then `second`.
/// No two have the same.
template <class Space>
SpaceIds<Space> places_of(const Space& space, Offset firsts, const SpaceIds<Space>& first,
                          const SpaceIds<Space>& second) {
  const auto rows = group_by_key<Id>("GALE::input_order", space, first.extent(0), firsts, first);
  const auto begin = rows.offsets;
  const auto row = rows.entries;
  parallel_for(
      "GALE::input_order", space, row.extent(0), KOKKOS_LAMBDA(Offset i) { row(i) = second(row(i)); });
  sort_rows(space, "GALE::input_order", rows);
  const auto place = allocate<SpaceIds<Space>>("GALE::input_numbers", row.extent(0));
  parallel_for(
      "GALE::input_numbers", space, row.extent(0),
      KOKKOS_LAMBDA(Offset i) { place(i) = find_in(row, begin(first(i)), begin(first(i) + 1), second(i)); });
  return place;
}

template <class Space>
SpaceIds<Space> sort_edges(const Space& space, const Simplices<MemoryOf<Space>>& simplices,
                           const Borrowed<Id, MemoryOf<Space>>& input) {
  const Offset edges = simplices.edge_low.extent(0);
  const auto low = allocate<SpaceIds<Space>>("GALE::edge_keys", edges),
             high = allocate<SpaceIds<Space>>("GALE::edge_keys", edges);
  parallel_for(
      "GALE::edge_keys", space, edges, KOKKOS_LAMBDA(Offset e) {
        const Id a = input(simplices.edge_low(e)), b = input(simplices.edge_high(e));
        low(e) = a < b ? a : b;
        high(e) = a < b ? b : a;
      });
  return places_of(space, input.extent(0), low, high);
}

/// Sorts by the edges' numbers.
template <class Space>
SpaceIds<Space> sort_triangles(const Space& space, const Simplices<MemoryOf<Space>>& simplices,
                               const Borrowed<Id, MemoryOf<Space>>& input, const SpaceIds<Space>& edges) {
  const Offset triangles = simplices.triangle_apex.extent(0);
  const auto first = allocate<SpaceIds<Space>>("GALE::triangle_keys", triangles),
             second = allocate<SpaceIds<Space>>("GALE::triangle_keys", triangles);
  parallel_for(
      "GALE::triangle_keys", space, edges.extent(0), KOKKOS_LAMBDA(Offset edge) {
        for (Id f = simplices.triangle_begin(edge); f < simplices.triangle_begin(edge + 1); ++f) {
          const Id vertices[3] = {simplices.edge_low(edge), simplices.edge_high(edge), simplices.triangle_apex(f)};
          int last = 0;  // the corner whose input id is highest; the edge of the others comes first
          for (int corner = 1; corner < 3; ++corner) {
            if (input(vertices[corner]) > input(vertices[last])) last = corner;
          }
          first(f) = edges(simplices.edge_of(vertices[last == 0 ? 1 : 0], vertices[last == 2 ? 1 : 2]));
          second(f) = input(vertices[last]);
        }
      });
  return places_of(space, edges.extent(0), first, second);
}

}  // namespace

template <class Space>
MadeNumbers number_by_sorting(const Space& space, const Simplices<MemoryOf<Space>>& simplices,
                              const Borrowed<Id, MemoryOf<Space>>& vertex_input, bool edges, bool triangles) {
  MadeNumbers numbers;
  const auto edge_numbers = sort_edges(space, simplices, vertex_input);
  if (edges) numbers.edges = edge_numbers;
  if (triangles) numbers.triangles = sort_triangles(space, simplices, vertex_input, edge_numbers);
  return numbers;
}

#define GALE_INSTANTIATE(Space)                                                           \
  template MadeNumbers number_by_sorting(const Space&, const Simplices<MemoryOf<Space>>&, \
                                         const Borrowed<Id, MemoryOf<Space>>&, bool, bool)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace detail

namespace {

template <class Space>
detail::MadeNumbers numbers_in(const Space& space, const Mesh& mesh, bool edges, bool triangles) {
  using Memory = MemoryOf<Space>;
  SimplexNeeds needs;
  needs.upto = triangles ? Enumeration::triangles : Enumeration::edges;
  needs.triangle_edge = false;
  const auto simplices = mesh.simplices<Memory>(needs);
  const detail::Borrowed<Id, Memory> input = mesh.vertex_input<Memory>();
  if constexpr (is_device<Space>) {
    const auto numbers = detail::number_by_sorting(space, simplices, input, edges, triangles);
    space.fence();
    return numbers;
  } else {
    return detail::number_by_vertex(simplices, input, edges, triangles);
  }
}

}  // namespace

detail::MadeNumbers detail::make_numbers(const Mesh& mesh, bool edges, bool triangles) {
  return in_worker_or_host_space(mesh, [&](const auto& space) { return numbers_in(space, mesh, edges, triangles); });
}

Array<const Id, HostMemory> input_numbers(const Mesh& mesh, int dimension) {
  if (dimension == 0) return mesh.vertex_input();
  if (dimension == mesh.dimension()) return mesh.cell_input();
  const auto numbers = detail::make_numbers(mesh, dimension == 1, dimension == 2);
  return (dimension == 1 ? numbers.edges : numbers.triangles).in<HostMemory>();
}

InputNumbers input_numbers(const Mesh& mesh) {
  const bool has_triangles = mesh.dimension() == 3;
  const auto numbers = detail::make_numbers(mesh, true, has_triangles);
  return {numbers.edges.in<HostMemory>(), has_triangles ? numbers.triangles.in<HostMemory>() : mesh.cell_input()};
}

}  // namespace gale
