#include <functional>
#include <utility>
#include <vector>

#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/morse_smale/condensed_paths.hpp>
#include <gale/algorithms/morse_smale/first_cells.hpp>
#include <gale/algorithms/morse_smale/jump.hpp>
#include <gale/algorithms/morse_smale/parts.hpp>
#include <gale/algorithms/morse_smale/paths_on_ranks.hpp>
#include <gale/base/error.hpp>
#include <gale/base/momentary.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>
#include <gale/mesh/exchange/exchange_plan.hpp>
#include <gale/mesh/exchange/places.hpp>

namespace gale::detail {

namespace {

template <class Space>
using Ids = Array<Id, MemoryOf<Space>>;

/// Where the paths of vertices end, by input id.
template <class Memory>
struct EndOfVertex {
  Array<const Id, Memory> starts;  ///< of each vertex (GALE's id) the entry where its path starts; none: itself
  Array<const Id, Memory> ends;    ///< of each entry, see jump()
  Array<const Id, Memory> names;   ///< of places of ends; none: the places
  OtherIds input;
  Array<Id, Memory> manifolds;  ///< where ids of the input are GALE's, it may be `starts` or, of none, `ends`

  KOKKOS_FUNCTION void operator()(Id v) const {
    const Id start = starts.extent(0) == 0 ? v : starts(v);
    const Id place = start == no_id ? no_id : place_of_end(ends(start));
    manifolds(input[v]) = place == no_id || names.extent(0) == 0 ? place : names(place);
  }
};

/// The manifolds of some vertices, among those of all: in `end.manifolds`, if there is such an array.
template <class Space>
Ids<Space> manifolds_of(const Space& space, const Mesh& mesh, Interval vertices, EndOfVertex<MemoryOf<Space>> end) {
  end.input = mesh.vertices_in_input<MemoryOf<Space>>();
  if (end.manifolds.extent(0) == 0) end.manifolds = allocate<Ids<Space>>("GALE::manifolds", mesh.vertices());
  const EndOfVertex<MemoryOf<Space>> of = end;
  parallel_for(
      "GALE::manifolds", space, vertices.size(), KOKKOS_LAMBDA(Offset i) { of(vertices.first + static_cast<Id>(i)); });
  space.fence();
  return end.manifolds;
}

template <class Space>
Mirrored<Id> manifolds_in(const Space& space, const DiscreteGradient& gradient, PathSimplices::Kind kind) {
  const Mesh& mesh = gradient.mesh();
  const CriticalSimplices& critical = gradient.critical();
  const Ids<Space> starts = kind == PathSimplices::Kind::falling_vertices ? Ids<Space>() : first_cells(space, mesh);
  const auto next = kind == PathSimplices::Kind::falling_vertices
                        ? with_ends(space, gradient.store().vertex_successors(), critical.vertices)
                        : condensed_paths(space, gradient.store().cell_successors(), critical.cells, starts).next;
  jump(space, next);
  // Each takes the place of where its path starts, if vertices keep their numbers.
  const bool in_place = mesh.vertices_in_input<MemoryOf<Space>>().table == nullptr;
  const Ids<Space> manifolds = !in_place ? Ids<Space>() : starts.extent(0) == 0 ? next : starts;
  return manifolds_of(space, mesh, {0, mesh.vertices()}, {starts, next, {}, {}, manifolds});
}

template <class Space>
Mirrored<Id> renamed_in(const Space& space, const Mirrored<Id>& manifolds, const std::vector<Id>& names) {
  const auto from = manifolds.in<MemoryOf<Space>>();
  const Momentary<const Id, MemoryOf<Space>> given("GALE::manifold_names",
                                                   Array<const Id, HostMemory>(names.data(), names.size()));
  const Array<const Id, MemoryOf<Space>> name = given.array();
  const auto to = allocate<Ids<Space>>("GALE::renamed_manifolds", from.extent(0));
  parallel_for(
      "GALE::rename_manifolds", space, from.extent(0),
      KOKKOS_LAMBDA(Offset v) { to(v) = from(v) == no_id ? no_id : name(from(v)); });
  space.fence();
  return to;
}

/// The manifolds of a rank's own vertices, and what is still to be done of its ghosts'.
struct OwnManifolds {
  std::vector<Id> given;  ///< of the vertices that others have as ghosts, as `from_owners` gives them
  std::function<Mirrored<Id>(const Array<Id, HostMemory>& taken)> finish;  ///< once others have given theirs
};

template <class Space>
OwnManifolds own_manifolds(const Space& space, const PathsOnRanks& paths, const Array<const Id, HostMemory>& names) {
  using Memory = MemoryOf<Space>;
  const Mesh& mesh = paths.simplices().mesh();
  const ExchangePlan& plan = mesh.exchange().from_owners();
  const Momentary<const Id, Memory> names_there("GALE::names_of_ends", names);
  const Ids<Space> manifolds =
      manifolds_of(space, mesh, mesh.owned_vertices(),
                   {paths.starts().in<Memory>(), paths.ends_here().in<Memory>(), names_there.array(), {}, {}});
  auto given = results_at("GALE::given_manifolds", space, Array<const Id, HostMemory>(plan.given_places()),
                          EntryAt<Id, Memory>{manifolds});
  return {std::move(given), [space, &plan, manifolds](const Array<Id, HostMemory>& taken) -> Mirrored<Id> {
            plan.fill_slots(space, taken, manifolds.data());
            return manifolds;
          }};
}

/// The places of a rank's critical simplices among those of all ranks, by global ids. Collective.
Array<GlobalId, HostMemory> places_among_all(const PathSimplices& simplices) {
  const Ranks& ranks = simplices.mesh().exchange().ranks();
  const std::vector<Id>& critical = simplices.critical();
  Array<SimplexKey, HostMemory> keys;
  together(ranks, [&] {
    keys = tabulated<SimplexKey>("GALE::critical_keys", static_cast<Offset>(critical.size()), [&](Offset i) {
      return SimplexKey{simplices.global(critical[i]), 0, 0};
    });
  });
  const PlacesOfAll found = places_of_keys(ranks, keys);
  together(ranks, [&] { require_ids("minima or maxima of all ranks", found.count); });
  return found.places;
}

/// The places among those of all ranks where the paths of vertices end. Collective.
Mirrored<Id> manifolds_on_ranks(const DiscreteGradient& gradient, PathSimplices::Kind kind, PathExits* exits) {
  const auto simplices = PathSimplices::make(gradient, kind);
  const Ranks& ranks = gradient.mesh().exchange().ranks();
  const std::vector<Id> none;
  const std::vector<Id>& others = exits == nullptr ? none : exits->starts.simplices;
  const PathsOnRanks paths(*simplices, places_among_all(*simplices), others);
  Array<const Id, HostMemory> places;
  together(ranks, [&] {
    if (exits != nullptr) exits->links = paths.exits_from(exits->starts.simplices);
    places = tabulated<Id>("GALE::places_of_ends", paths.ends(),
                           [&](Offset end) { return static_cast<Id>(paths.final_name(static_cast<Id>(end))); });
  });
  return ends_of_vertices(paths, places);
}

Mirrored<Id> manifolds(const DiscreteGradient& gradient, PathSimplices::Kind kind, PathExits* exits) {
  if (gradient.mesh().exchange().ranks().size() > 1) return manifolds_on_ranks(gradient, kind, exits);
  return in_worker_or_host_space(gradient.mesh(),
                                 [&](const auto& space) { return manifolds_in(space, gradient, kind); });
}

}  // namespace

Mirrored<Id> ends_of_vertices(const PathsOnRanks& paths, const Array<const Id, HostMemory>& names) {
  OwnManifolds own;
  together(paths.ranks(), [&] {
    own = in_worker_or_host_space(paths.ends_here().on_device(),
                                  [&](const auto& space) { return own_manifolds(space, paths, names); });
  });
  const auto taken = paths.simplices().mesh().exchange().from_owners().fetch(
      paths.ranks(), Array<Id, HostMemory>(own.given.data(), own.given.size()));
  Mirrored<Id> ends;
  together(paths.ranks(), [&] { ends = own.finish(taken.entries); });
  return ends;
}

Mirrored<Id> descending_manifolds(const DiscreteGradient& gradient, PathExits* exits) {
  return manifolds(gradient, PathSimplices::Kind::falling_vertices, exits);
}

Mirrored<Id> ascending_manifolds(const DiscreteGradient& gradient, PathExits* exits) {
  return manifolds(gradient, PathSimplices::Kind::rising_cells, exits);
}

void find_exits(const DiscreteGradient& gradient, PathSimplices::Kind kind, PathExits& exits) {
  const auto simplices = PathSimplices::make(gradient, kind);
  const PathsOnRanks paths(*simplices, exits.starts.simplices);
  together(paths.ranks(), [&] { exits.links = paths.exits_from(exits.starts.simplices); });
}

Mirrored<Id> renamed(const Mirrored<Id>& manifolds, const std::vector<Id>& names) {
  return in_worker_or_host_space(manifolds.on_device(),
                                 [&](const auto& space) { return renamed_in(space, manifolds, names); });
}

}  // namespace gale::detail
