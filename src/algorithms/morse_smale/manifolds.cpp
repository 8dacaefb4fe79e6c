#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/morse_smale/jump.hpp>
#include <gale/algorithms/morse_smale/parts.hpp>
#include <gale/algorithms/morse_smale/paths_on_ranks.hpp>
#include <gale/base/bits.hpp>
#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort.hpp>
#include <gale/base/transfer.hpp>
#include <gale/mesh/exchange/exchange_plan.hpp>
#include <gale/mesh/exchange/places.hpp>

namespace gale::detail {

namespace {

template <class Space>
using Ids = Array<Id, MemoryOf<Space>>;
template <class Space>
using Keys = Array<std::uint64_t, MemoryOf<Space>>;

template <class Space>
Mirrored<Id> descending_in(const Space& space, const DiscreteGradient& gradient) {
  const auto next = with_ends(space, gradient.store().vertex_successors(), gradient.critical().vertices);
  jump(space, next);
  const OtherIds input = gradient.mesh().vertices_in_input<MemoryOf<Space>>();
  const auto manifolds = allocate<Ids<Space>>("GALE::descending_manifolds", next.extent(0));
  parallel_for(
      "GALE::descending_manifolds", space, next.extent(0),
      KOKKOS_LAMBDA(Offset v) { manifolds(input[v]) = place_of_end(next(v)); });
  space.fence();
  return manifolds;
}

constexpr std::uint64_t no_first = ~std::uint64_t(0);

/// What first_cells does of a grid, where each vertex knows its cells.
template <class Space>
void first_cells_of_grid(const Space& space, const Mesh& mesh, const Keys<Space>& first) {
  const GridView grid = mesh.grid()->in<MemoryOf<Space>>();
  const StarKind* const kinds = mesh.grid()->kinds_in<MemoryOf<Space>>();
  const Id* const begin = mesh.interval_begin<MemoryOf<Space>>(0).data();
  parallel_for(
      "GALE::first_cells", space, mesh.segments(), KOKKOS_LAMBDA(Offset s) {
        GridCursor at(grid);
        for (Id v = begin[s]; v < begin[s + 1]; ++v) {
          at.go_to(v);
          const Id cell = at.cell(kinds[at.kind()].cell[0]);
          first(v) = pair_key(cell, cell);
        }
      });
}

/// For each vertex (GALE's id) its cell of lowest input id, with that id in the upper half; `no_first` where it has no
/// cell.
template <class Space>
Keys<Space> first_cells(const Space& space, const Mesh& mesh) {
  const auto first = allocate<Keys<Space>>("GALE::first_cells", mesh.vertices());
  if (mesh.grid() != nullptr) {
    first_cells_of_grid(space, mesh, first);
    return first;
  }
  const auto encoded = mesh.encoded<MemoryOf<Space>>();
  const auto input = mesh.cell_input<MemoryOf<Space>>();
  parallel_for(
      "GALE::first_cells", space, mesh.segments(), KOKKOS_LAMBDA(Offset s) {
        const Id begin = encoded.vertex_begin(s), end = encoded.vertex_begin(s + 1);
        const auto offer = [&](Id t) {
          const std::uint64_t key = pair_key(input(t), t);
          for (int corner = 0; corner < 4; ++corner) {
            const Id v = encoded.cells(t, corner);
            if (v >= begin && v < end && key < first(v)) first(v) = key;
          }
        };
        for (Id v = begin; v < end; ++v) first(v) = no_first;
        for (Id t = encoded.internal_begin(s); t < encoded.internal_begin(s + 1); ++t) offer(t);
        for (Offset i = encoded.external_begin(s); i < encoded.external_begin(s + 1); ++i) offer(encoded.external(i));
      });
  return first;
}

template <class Space>
Mirrored<Id> ascending_in(const Space& space, const DiscreteGradient& gradient) {
  const auto next = with_ends(space, gradient.store().cell_successors(), gradient.critical().cells);
  jump(space, next);
  const auto first = first_cells(space, gradient.mesh());
  const OtherIds input = gradient.mesh().vertices_in_input<MemoryOf<Space>>();
  const auto manifolds = allocate<Ids<Space>>("GALE::ascending_manifolds", first.extent(0));
  parallel_for(
      "GALE::ascending_manifolds", space, first.extent(0), KOKKOS_LAMBDA(Offset v) {
        const Id cell = pair_second(first(v));
        manifolds(input[v]) = first(v) == no_first || next(cell) == path_outside ? no_id : place_of_end(next(cell));
      });
  space.fence();
  return manifolds;
}

constexpr std::uint64_t no_pair = ~std::uint64_t(0);

template <class Space>
std::pair<Mirrored<Id>, Id> pairs_in(const Space& space, const Mirrored<Id>& ascending,
                                     const Mirrored<Id>& descending) {
  const Offset count = ascending.size();
  const auto up = ascending.in<MemoryOf<Space>>(), down = descending.in<MemoryOf<Space>>();
  const auto keys = allocate<Keys<Space>>("GALE::manifold_pairs", count);
  const auto vertices = allocate<Ids<Space>>("GALE::manifold_vertices", count);
  parallel_for(
      "GALE::manifold_pairs", space, count, KOKKOS_LAMBDA(Offset v) {
        keys(v) = up(v) == no_id ? no_pair : pair_key(up(v), down(v));
        vertices(v) = static_cast<Id>(v);
      });
  stable_sort_by_key(space, keys, vertices);
  const auto before = allocate<Ids<Space>>("GALE::manifold_number", count + 1);  // how many pairs begin earlier
  const Id distinct = exclusive_scan(
      "GALE::count_manifolds", space, count, before,
      KOKKOS_LAMBDA(Offset i) { return keys(i) != no_pair && (i == 0 || keys(i) != keys(i - 1)); });
  const auto manifolds = allocate<Ids<Space>>("GALE::morse_smale_manifolds", count);
  parallel_for(
      "GALE::morse_smale_manifolds", space, count,
      KOKKOS_LAMBDA(Offset i) { manifolds(vertices(i)) = keys(i) == no_pair ? no_id : before(i + 1) - 1; });
  space.fence();
  return {manifolds, distinct};
}

template <class Space>
Mirrored<Id> renamed_in(const Space& space, const Mirrored<Id>& manifolds, const std::vector<Id>& names) {
  const auto from = manifolds.in<MemoryOf<Space>>();
  const auto name = in_memory<MemoryOf<Space>>(Array<const Id, HostMemory>(names.data(), names.size()));
  const auto to = allocate<Ids<Space>>("GALE::renamed_manifolds", from.extent(0));
  parallel_for(
      "GALE::rename_manifolds", space, from.extent(0),
      KOKKOS_LAMBDA(Offset v) { to(v) = from(v) == no_id ? no_id : name(from(v)); });
  space.fence();
  return to;
}

/// The places among those of all ranks where the paths from vertices end that start at start_of(vertex), which is a
/// simplex or no_id, by GALE's ids. Collective.
template <class StartOf>
Mirrored<Id> manifolds_on_ranks(const PathSimplices& simplices, PathExits* exits, const StartOf& start_of) {
  const Mesh& mesh = simplices.mesh();
  std::vector<Id> elsewhere;
  together(mesh.exchange().ranks(), [&] {
    const auto& successors = simplices.successors().in<HostMemory>();
    const Interval owned = mesh.owned_vertices(), inner = simplices.inner();
    elsewhere = collected<Id>("GALE::starts_elsewhere", owned.size(), [&](Offset i, const auto& add) {
      const Id start = start_of(owned.first + static_cast<Id>(i));
      if (start == no_id || inner.has(start)) return;
      if (successors(start) == DiscreteGradient::elsewhere) add(start);
    });
  });
  const PathsOnRanks paths(simplices, elsewhere);
  const auto places = paths.places_of_ends();
  Array<Id, HostMemory> manifolds;
  together(paths.ranks(), [&] {
    if (exits != nullptr) {
      exits->exits = paths.exits_from(exits->starts.simplices);
      exits->are_known = true;
    }
    const OtherIds input = mesh.vertices_in_input();
    const Interval owned = mesh.owned_vertices();
    manifolds = allocate<Array<Id, HostMemory>>("GALE::manifolds", mesh.vertices());
    parallel_for("GALE::manifolds", HostExecutionSpace(), mesh.vertices(), [&](Offset v) {
      const Id start = owned.has(static_cast<Id>(v)) ? start_of(static_cast<Id>(v)) : no_id;
      const Id end = start == no_id ? no_id : paths.end(start);
      manifolds(input[v]) = end == no_id ? no_id : places(end);
    });
  });
  mesh.exchange().from_owners()(paths.ranks(), manifolds.data(), manifolds.data());
  return manifolds;
}

Mirrored<Id> descending_on_ranks(const DiscreteGradient& gradient, PathExits* exits) {
  const auto vertices = PathSimplices::make(gradient, PathSimplices::Kind::falling_vertices);
  return manifolds_on_ranks(*vertices, exits, [](Id v) { return v; });
}

Mirrored<Id> ascending_on_ranks(const DiscreteGradient& gradient, PathExits* exits) {
  const auto cells = PathSimplices::make(gradient, PathSimplices::Kind::rising_cells);
  Array<std::uint64_t, HostMemory> first;
  together(gradient.mesh().exchange().ranks(), [&] { first = first_cells(HostExecutionSpace(), gradient.mesh()); });
  return manifolds_on_ranks(*cells, exits,
                            [&](Id v) { return first(v) == no_first ? no_id : Id(pair_second(first(v))); });
}

/// The pairs that this rank has numbered among themselves get their places among those of all.
std::pair<Mirrored<Id>, Id> pairs_on_ranks(const Ranks& ranks, const Mirrored<Id>& ascending,
                                           const Mirrored<Id>& descending, const Mirrored<Id>& numbers, Id count) {
  Array<SimplexKey, HostMemory> keys;
  together(ranks, [&] {
    const auto &of_vertex = numbers.in<HostMemory>(), &up = ascending.in<HostMemory>(),
               &down = descending.in<HostMemory>();
    keys = allocate<decltype(keys)>("GALE::manifold_pairs", count);
    for (std::size_t v = 0; v < of_vertex.extent(0); ++v) {
      if (of_vertex(v) != no_id) keys(of_vertex(v)) = {up(v), down(v), 0};
    }
  });
  const KeyPlaces found = places_of_keys(ranks, keys);
  Mirrored<Id> all;
  together(ranks, [&] {
    require_ids("Morse-Smale manifolds of all ranks", found.count);
    all = renamed(numbers, std::vector<Id>(found.places.data(), found.places.data() + count));
  });
  return {all, static_cast<Id>(found.count)};
}

}  // namespace

Mirrored<Id> descending_manifolds(const DiscreteGradient& gradient, PathExits* exits) {
  if (gradient.mesh().exchange().ranks().size() > 1) return descending_on_ranks(gradient, exits);
  return in_worker_or_host_space(gradient.mesh(), [&](const auto& space) { return descending_in(space, gradient); });
}

Mirrored<Id> ascending_manifolds(const DiscreteGradient& gradient, PathExits* exits) {
  if (gradient.mesh().exchange().ranks().size() > 1) return ascending_on_ranks(gradient, exits);
  return in_worker_or_host_space(gradient.mesh(), [&](const auto& space) { return ascending_in(space, gradient); });
}

std::pair<Mirrored<Id>, Id> morse_smale_manifolds(const Mesh& mesh, const Mirrored<Id>& ascending,
                                                  const Mirrored<Id>& descending) {
  const Ranks& ranks = mesh.exchange().ranks();
  std::pair<Mirrored<Id>, Id> pairs;
  together(ranks, [&] {
    pairs = in_worker_or_host_space(ascending.on_device(),
                                    [&](const auto& space) { return pairs_in(space, ascending, descending); });
  });
  return ranks.size() == 1 ? pairs : pairs_on_ranks(ranks, ascending, descending, pairs.first, pairs.second);
}

Mirrored<Id> renamed(const Mirrored<Id>& manifolds, const std::vector<Id>& names) {
  return in_worker_or_host_space(manifolds.on_device(),
                                 [&](const auto& space) { return renamed_in(space, manifolds, names); });
}

}  // namespace gale::detail
