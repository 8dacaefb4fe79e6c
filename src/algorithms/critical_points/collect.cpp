#include <gale/algorithms/critical_points/vertex_types.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>
#include <gale/mesh/exchange/exchange_plan.hpp>

namespace gale::detail {

namespace {

/// What is said of an owned vertex that isn't regular.
struct CriticalVertex {
  Id input;
  CriticalType type;
  bool on_surface;
};

/// The owned vertices that aren't regular, once all are set and told.
template <class Space>
CriticalPoints owned_points(const Space& space, const Mesh& mesh, const VertexTypes<MemoryOf<Space>>& types) {
  const Offset count = mesh.vertices();
  const OtherIds internal = mesh.vertices_of_input<MemoryOf<Space>>();
  const Interval owned = mesh.owned_vertices();
  const auto place = allocate<Array<Id, MemoryOf<Space>>>("GALE::critical_place", count + 1);
  const Id total = exclusive_scan(
      "GALE::count_critical", space, count, place, KOKKOS_LAMBDA(Offset i) {
        return Id(owned.has(internal[i]) && types.type(internal[i]) != CriticalType::regular);
      });
  const auto found = allocate<Array<CriticalVertex, MemoryOf<Space>>>("GALE::critical_vertices", total);
  parallel_for(
      "GALE::collect_critical", space, count, KOKKOS_LAMBDA(Offset i) {
        const Id v = internal[i];
        if (place(i + 1) != place(i)) found(place(i)) = {static_cast<Id>(i), types.type(v), types.on_surface(v)};
      });
  space.fence();
  const auto here = on_host(found);
  CriticalPoints points;
  for (Id i = 0; i < total; ++i) {
    const CriticalVertex& vertex = here(i);
    points.vertices.push_back(vertex.input);
    points.types.push_back(vertex.type);
    points.on_surface.push_back(vertex.on_surface);
    ++points.counts[static_cast<int>(vertex.type)];
  }
  return points;
}

template <class Space>
using Flags = Array<std::uint8_t, MemoryOf<Space>>;

/// Which of the vertices that others have as ghosts are on the surface, in the order in which they are told.
template <class Space>
Flags<HostExecutionSpace> told_flags(const Space& space, const Mesh& mesh, const VertexTypes<MemoryOf<Space>>& types) {
  const Array<Id, MemoryOf<Space>> places = in_memory<MemoryOf<Space>>(mesh.exchange().from_owners().given_places());
  const auto flags = allocate<Flags<Space>>("GALE::surface_flags", places.extent(0));
  const OtherIds internal = mesh.vertices_of_input<MemoryOf<Space>>();
  parallel_for(
      "GALE::surface_flags", space, places.extent(0),
      KOKKOS_LAMBDA(Offset i) { flags(i) = types.on_surface(internal[places(i)]); });
  space.fence();
  return on_host(flags);
}

/// Which of this rank's ghosts are on the surface, as their owners say: by GALE's id, 0 of owned ones.
template <class Space>
Flags<Space> ghost_flags(const Space& space, const Mesh& mesh, const VertexTypes<MemoryOf<Space>>& types) {
  Flags<HostExecutionSpace> told;
  together(mesh.exchange().ranks(), [&] { told = told_flags(space, mesh, types); });
  const auto fetched = mesh.exchange().from_owners().fetch(mesh.exchange().ranks(), told);
  Flags<Space> flags;
  together(mesh.exchange().ranks(), [&] {
    flags = allocate<Flags<Space>>("GALE::ghost_flags", mesh.vertices());
    fill("GALE::ghost_flags", space, flags, std::uint8_t(0));
    const OtherIds internal = mesh.vertices_of_input<MemoryOf<Space>>();
    const Array<Id, MemoryOf<Space>> slots = in_memory<MemoryOf<Space>>(mesh.exchange().from_owners().slots());
    const Flags<Space> values = in_memory<MemoryOf<Space>>(fetched.entries);
    const Flags<Space> to = flags;
    parallel_for(
        "GALE::ghost_flags", space, slots.extent(0), KOKKOS_LAMBDA(Offset i) { to(internal[slots(i)]) = values(i); });
    space.fence();
  });
  return flags;
}

/// Has ghosts on the surface tell their neighbours, as the sweep has owned vertices do.
template <class Space>
void tell_of_ghosts(const Space& space, const VertexOrder& order, const Flags<Space>& on_surface,
                    const VertexTypes<MemoryOf<Space>>& types) {
  using Memory = MemoryOf<Space>;
  const Mesh& mesh = order.mesh();
  const Interval owned = mesh.owned_vertices();
  if (owned.size() == mesh.vertices()) return;
  const std::uint64_t* const keys = order.keys_in<Memory>().data();
  if (mesh.grid() != nullptr) {
    const GridView grid = mesh.grid()->in<Memory>();
    const StarKind* const kinds = mesh.grid()->kinds_in<Memory>();
    parallel_for(
        "GALE::tell_of_ghosts", space, mesh.vertices() - owned.size(), KOKKOS_LAMBDA(Offset i) {
          const Id ghost = owned.outside(i);
          if (!on_surface(ghost)) return;
          GridCursor at(grid);
          at.go_to(ghost);
          const StarKind& kind = kinds[at.kind()];
          for (int k = 0; k < kind.neighbours; ++k) {
            const Id neighbour = at.neighbour(kind.direction[k]);
            if (owned.has(neighbour)) types.tell(keys, neighbour, ghost);
          }
        });
    space.fence();
    return;
  }
  const CellReader cell = mesh.cell_reader<Memory>();
  parallel_for(
      "GALE::tell_of_ghosts", space, mesh.cells(), KOKKOS_LAMBDA(Offset t) {
        const Quad corners = cell(static_cast<Id>(t));
        if (owned.has(corners.a) && owned.has(corners.d)) return;
        for (int i = 0; i < 4; ++i) {
          if (!on_surface(corners[i])) continue;
          for (int k = 0; k < 4; ++k) {
            if (owned.has(corners[k])) types.tell(keys, corners[k], corners[i]);
          }
        }
      });
  space.fence();
}

}  // namespace

template <class Space>
CriticalPoints collect(const Space& space, const VertexOrder& order, const VertexTypes<MemoryOf<Space>>& types) {
  const Mesh& mesh = order.mesh();
  const Ranks& ranks = mesh.exchange().ranks();
  const bool ghosts_tell = ranks.size() > 1 && mesh.dimension() == 3;
  Flags<Space> flags;
  if (ghosts_tell) flags = ghost_flags(space, mesh, types);
  CriticalPoints points;
  together(ranks, [&] {
    if (ghosts_tell) tell_of_ghosts(space, order, flags, types);
    points = owned_points(space, mesh, types);
  });
  ranks.sum(points.counts.data(), static_cast<int>(points.counts.size()));
  return points;
}

#define GALE_INSTANTIATE(Space) \
  template CriticalPoints collect<Space>(const Space&, const VertexOrder&, const VertexTypes<MemoryOf<Space>>&)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
