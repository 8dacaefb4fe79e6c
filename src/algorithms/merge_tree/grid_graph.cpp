#include <algorithm>

#include <gale/algorithms/merge_tree/extremum_graph.hpp>
#include <gale/base/parallel.hpp>
#include <gale/mesh/grid.hpp>
#include <gale/runtime/sweep.hpp>

namespace gale::detail {

/// Finds the graph of a grid's vertices, one after the other, from what directions its neighbours lie in.
struct ExtremaOnGrid {
  GridView grid;
  const StarKind* kinds;
  const std::uint64_t* keys;
  Id* next[2];

  GALE_CALLS_ANY
  template <class Found>
  KOKKOS_FORCEINLINE_FUNCTION void operator()(GridCursor& at, Id vertex, Found& found) const {
    at.go_to(vertex);
    const StarKind& kind = kinds[at.kind()];
    const std::uint64_t own = keys[vertex];
    std::uint64_t least = own, greatest = own;
    Id first[2] = {no_id, no_id};
    std::uint32_t lower = 0;
    for (int i = 0; i < kind.neighbours; ++i) {
      const int direction = kind.direction[i];
      const Id neighbour = at.neighbour(direction);
      const std::uint64_t key = keys[neighbour];
      lower |= std::uint32_t(key < own) << direction;
      if (key < least) {
        least = key;
        first[below] = neighbour;
      }
      if (key > greatest) {
        greatest = key;
        first[above] = neighbour;
      }
    }
    next[below][vertex] = first[below];
    next[above][vertex] = first[above];
    tell(at, kind, below, lower, found);
    tell(at, kind, above, kind.directions & ~lower, found);
  }

 private:
  GALE_CALLS_ANY
  template <class Found>
  KOKKOS_FORCEINLINE_FUNCTION void tell(const GridCursor& at, const StarKind& kind, Side side, std::uint32_t rest,
                                        Found& found) const {
    if (rest == 0) {
      found.add_extremum(side, at.vertex());
      return;
    }
    if (kind.components(rest) == 1) return;
    while (rest != 0) {
      std::uint32_t front = rest & (~rest + 1);
      rest &= ~front;
      found.add_meeting(side, {at.vertex(), at.neighbour(lowest_bit(front))});
      while (front != 0) {
        const std::uint32_t met = kind.touching[lowest_bit(front)] & rest;
        front = (front & (front - 1)) | met;
        rest &= ~met;
      }
    }
  }
};

namespace {

/// A lane's way to its vertex.
struct FindOnGrid {
  ExtremaOnGrid find;
  ExtremaOfLanes found;
  Id first;

  KOKKOS_FUNCTION void operator()(Offset i) const {
    GridCursor at(find.grid);
    find(at, first + static_cast<Id>(i), found);
  }
};

}  // namespace

template <class Space>
ExtremumGraph<MemoryOf<Space>> extremum_graph_of_grid(const Space& space, const VertexOrder& order,
                                                      const SweepOptions& options) {
  using Memory = MemoryOf<Space>;
  const Mesh& mesh = order.mesh();
  const Grid& grid = *mesh.grid();
  ExtremumGraph<Memory> graph = unknown_graph(space, mesh);
  const ExtremaOnGrid find{grid.in<Memory>(),
                           grid.kinds_in<Memory>(),
                           order.keys_in<Memory>().data(),
                           {graph[below].next.data(), graph[above].next.data()}};
  if constexpr (is_device<Space>) {
    const Interval owned = mesh.owned_vertices();
    for (Offset room = owned.size() / 16 + 1024;;) {
      const FindOnGrid all{find, ExtremaOfLanes(room), owned.first};
      parallel_for("GALE::extrema_on_grid", space, owned.size(), all);
      space.fence();
      if (all.found.give(graph, room)) return graph;
    }
  } else {
    std::vector<ExtremumFinder> finders(std::max(options.threads, 0), ExtremumFinder(find.keys));
    const Id* const begin = mesh.vertex_begin().data();
    sweep(mesh.owned_segments(), options, [&](int consumer, Id segment) {
      GridCursor at(find.grid);
      for (Id v = begin[segment]; v < begin[segment + 1]; ++v) find(at, v, finders[consumer]);
    });
    add_found(finders, graph);
    return graph;
  }
}

#define GALE_INSTANTIATE(Space)                                                                           \
  template ExtremumGraph<MemoryOf<Space>> extremum_graph_of_grid<Space>(const Space&, const VertexOrder&, \
                                                                        const SweepOptions&)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
