#include <gale/base/group_by.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort_rows.hpp>
#include <gale/mesh/number_by_sorting.hpp>

namespace gale::detail {

namespace {

template <class Space>
using SpaceIds = Array<Id, MemoryOf<Space>>;

KOKKOS_INLINE_FUNCTION void order(Id& a, Id& b) {
  if (b < a) {
    const Id low = b;
    b = a;
    a = low;
  }
}

template <class Memory>
struct EntryAt {
  Array<Id, Memory> entries;

  KOKKOS_FUNCTION Id operator()(Id i) const { return entries(i); }
};

/// The places that simplices have in order, by two numbers each: `first`, of which there are `firsts`, then `second`.
/// No two have the same.
template <class Space>
SpaceIds<Space> places_of(const Space& space, Offset firsts, const SpaceIds<Space>& first,
                          const SpaceIds<Space>& second) {
  const auto groups =
      group_by_key<Id>("GALE::input_order", space, first.extent(0), firsts, EntryAt<MemoryOf<Space>>{first});
  const auto begin = groups.begin;
  const auto row = groups.members;
  parallel_for(
      "GALE::input_order", space, row.extent(0), KOKKOS_LAMBDA(Offset i) { row(i) = second(row(i)); });
  sort_rows(space, "GALE::input_order", begin, row);
  const auto place = allocate<SpaceIds<Space>>("GALE::input_numbers", row.extent(0));
  parallel_for(
      "GALE::input_numbers", space, row.extent(0),
      KOKKOS_LAMBDA(Offset i) { place(i) = find_in(row, begin(first(i)), begin(first(i) + 1), second(i)); });
  return place;
}

}  // namespace

template <class Space>
Array<Id, MemoryOf<Space>> sort_edges(const Space& space, const Simplices<MemoryOf<Space>>& simplices,
                                      const VertexInput<MemoryOf<Space>>& input) {
  const Offset edges = simplices.edge_low.extent(0);
  const auto low = allocate<SpaceIds<Space>>("GALE::edge_keys", edges),
             high = allocate<SpaceIds<Space>>("GALE::edge_keys", edges);
  parallel_for(
      "GALE::edge_keys", space, edges, KOKKOS_LAMBDA(Offset e) {
        Id a = input(simplices.edge_low(e)), b = input(simplices.edge_high(e));
        order(a, b);
        low(e) = a;
        high(e) = b;
      });
  return places_of(space, input.extent(0), low, high);
}

template <class Space>
Array<Id, MemoryOf<Space>> sort_triangles(const Space& space, const Simplices<MemoryOf<Space>>& simplices,
                                          const VertexInput<MemoryOf<Space>>& input) {
  const auto edges = sort_edges(space, simplices, input);
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

#define GALE_INSTANTIATE(Space)                                                                       \
  template Array<Id, MemoryOf<Space>> sort_edges(const Space&, const Simplices<MemoryOf<Space>>&,     \
                                                 const VertexInput<MemoryOf<Space>>&);                \
  template Array<Id, MemoryOf<Space>> sort_triangles(const Space&, const Simplices<MemoryOf<Space>>&, \
                                                     const VertexInput<MemoryOf<Space>>&)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
