#include <gale/algorithms/critical_points/vertex_types.hpp>
#include <gale/base/parallel.hpp>
#include <gale/mesh/grid.hpp>
#include <gale/runtime/sweep.hpp>

namespace gale::detail {

namespace {

/// Components of both sides, for each set of directions in which neighbours are lower, where all cubes are there.
template <class Space>
Array<std::uint8_t, MemoryOf<Space>> topologies(const Space& space, const StarKind* kinds, int whole_kind) {
  const auto table = allocate<Array<std::uint8_t, MemoryOf<Space>>>("GALE::link_topologies", 1 << grid_directions);
  parallel_for(
      "GALE::link_topologies", space, table.extent(0), KOKKOS_LAMBDA(Offset lower) {
        const StarKind& kind = kinds[whole_kind];
        const auto below = static_cast<std::uint32_t>(lower) & kind.directions;
        table(lower) =
            static_cast<std::uint8_t>(kind.components(below) | kind.components(kind.directions & ~below) << 4);
      });
  return table;
}

}  // namespace

/// Classifies the vertices of a grid, one after the other.
template <class Memory>
struct ClassifyOnGrid {
  GridView grid;
  const StarKind* kinds;
  const std::uint8_t* table;
  int whole_kind;
  const std::uint64_t* keys;
  VertexTypes<Memory> types;

  KOKKOS_FORCEINLINE_FUNCTION void operator()(GridCursor& at, Id v) const {
    at.go_to(v);
    const StarKind& kind = kinds[at.kind()];
    if (at.kind() == whole_kind) {
      const std::uint8_t sides = table[lower_neighbours(at, kind)];
      types.set(keys, v, {}, {sides & 15, sides >> 4, false});
      return;
    }
    const std::uint32_t lower = lower_neighbours(at, kind);
    Id neighbours[grid_directions];
    for (int i = 0; i < kind.neighbours; ++i) neighbours[i] = at.neighbour(kind.direction[i]);
    types.set(keys, v, {neighbours, kind.neighbours},
              {kind.components(lower), kind.components(kind.directions & ~lower), kind.is_open != 0});
  }

 private:
  /// In which directions neighbours are lower.
  KOKKOS_FORCEINLINE_FUNCTION std::uint32_t lower_neighbours(const GridCursor& at, const StarKind& kind) const {
    const std::uint64_t key = keys[at.vertex()];
    std::uint32_t lower = 0;
    if (at.kind() == grid_kinds - 1) {
      for (int d = 0; d < grid_directions; ++d) lower |= std::uint32_t(keys[at.neighbour(d)] < key) << d;
    } else {
      for (int i = 0; i < kind.neighbours; ++i) {
        const int d = kind.direction[i];
        lower |= std::uint32_t(keys[at.neighbour(d)] < key) << d;
      }
    }
    return lower;
  }
};

namespace {

template <class Space>
VertexTypes<MemoryOf<Space>> classify(const Space& space, const VertexOrder& order, const SweepOptions& options) {
  using Memory = MemoryOf<Space>;
  const Mesh& mesh = order.mesh();
  const Grid& grid = *mesh.grid();
  [[maybe_unused]] const Interval owned = mesh.owned_vertices();
  const int whole_kind = mesh.dimension() == 3 ? grid_kinds - 1 : (grid_kinds - 1) & 0xf0;
  const StarKind* const kinds = grid.kinds_in<Memory>();
  const auto table = topologies(space, kinds, whole_kind);
  const ClassifyOnGrid<Memory> classify{
      grid.in<Memory>(), kinds, table.data(), whole_kind, order.keys_in<Memory>().data(), VertexTypes<Memory>(mesh)};
  if constexpr (is_device<Space>) {
    parallel_for(
        "GALE::classify_on_grid", space, owned.size(), KOKKOS_LAMBDA(Offset i) {
          GridCursor at(classify.grid);
          classify(at, owned.first + static_cast<Id>(i));
        });
    space.fence();
  } else {
    const Id* const begin = mesh.vertex_begin().data();
    sweep(mesh.owned_segments(), options, [&](int, Id segment) {
      GridCursor at(classify.grid);
      for (Id v = begin[segment]; v < begin[segment + 1]; ++v) classify(at, v);
    });
  }
  return classify.types;
}

}  // namespace

template <class Space>
CriticalPoints critical_points_of_grid(const Space& space, const VertexOrder& order, const SweepOptions& options) {
  const ThreadLimit limit(options.threads);
  VertexTypes<MemoryOf<Space>> types;
  together(order.mesh().exchange().ranks(), [&] { types = classify(space, order, options); });
  return collect(space, order, types);
}

#define GALE_INSTANTIATE(Space) \
  template CriticalPoints critical_points_of_grid<Space>(const Space&, const VertexOrder&, const SweepOptions&)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
