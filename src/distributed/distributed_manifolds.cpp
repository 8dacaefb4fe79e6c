#include <tuple>
#include <utility>

#include <gale/algorithms/morse_smale/first_tetrahedra.hpp>
#include <gale/algorithms/morse_smale/manifolds.hpp>
#include <gale/distributed/distributed_manifolds.hpp>
#include <gale/distributed/exchange_plan.hpp>
#include <gale/distributed/gradient_paths.hpp>
#include <gale/distributed/key_places.hpp>
#include <gale/distributed/places_of_ends.hpp>

namespace gale {

namespace {

using GlobalIds = Array<GlobalId, HostMemory>;
using LocalIds = Array<Id, HostMemory>;

/// Has ghosts have what their owners found.
void complete(const DistributedMesh& mesh, const GlobalIds& labels) {
  mesh.from_owners()(mesh.ranks(), labels.data(), labels.data());
}

/// Where paths from the vertices that this rank owns end. By local input id.
struct Ends {
  LocalIds ends;     ///< on this rank; no_id if finally outside, and of ghosts
  GlobalIds places;  ///< finally, of ghosts too; -1 if outside
};

/// From end_of(vertex), an end on this rank or no_id, by GALE's id; and the places of ends.
template <class EndOf>
Ends ends_by(const DistributedMesh& mesh, const Array<const GlobalId, HostMemory>& places, const EndOf& end_of) {
  const Mesh& local = mesh.local();
  const Id* const input = local.vertex_input().data();
  Ends found;
  detail::together(mesh.ranks(), [&] {
    found.ends = allocate<LocalIds>("GALE::path_ends", local.vertices());
    found.places = allocate<GlobalIds>("GALE::manifolds", local.vertices());
    parallel_for("GALE::manifolds", HostExecutionSpace(), local.vertices(), [&](Offset v) {
      const Id end = v < local.owned_vertices() ? end_of(static_cast<Id>(v)) : no_id;
      const GlobalId place = end == no_id ? -1 : places(end);
      found.ends(input[v]) = place < 0 ? no_id : end;
      found.places(input[v]) = place;
    });
  });
  complete(mesh, found.places);
  return found;
}

Ends descending(const DistributedGradient& gradient, int& rounds) {
  const Communicator& ranks = gradient.mesh.ranks();
  const detail::DistributedPaths paths(ranks, detail::falling_simplices(gradient));
  rounds += paths.rounds();
  return ends_by(gradient.mesh, detail::places_of_ends(ranks, paths), [&](Id v) { return paths.end(v); });
}

Ends ascending(const DistributedGradient& gradient, int& rounds) {
  const Communicator& ranks = gradient.mesh.ranks();
  const detail::DistributedPaths paths(ranks, detail::rising_simplices(gradient));
  rounds += paths.rounds();
  Array<std::uint64_t, HostMemory> first;
  detail::together(ranks, [&] { first = detail::first_tetrahedra(HostExecutionSpace(), gradient.mesh.local()); });
  return ends_by(gradient.mesh, detail::places_of_ends(ranks, paths),
                 [&](Id v) { return first(v) == detail::no_first ? no_id : paths.end(pair_second(first(v))); });
}

/// Numbers the pairs of both: first the different ones on each rank, then those of all.
std::pair<GlobalIds, GlobalId> find_pairs(const DistributedMesh& mesh, const Ends& up, const Ends& down) {
  const Offset vertices = mesh.local().vertices();
  Array<const Id, HostMemory> numbers;
  Array<detail::SimplexKey, HostMemory> keys;
  GlobalIds pairs;
  detail::together(mesh.ranks(), [&] {
    const auto [of_vertices, count] = detail::morse_smale_manifolds(up.ends, down.ends);
    numbers = of_vertices.in<HostMemory>();
    keys = allocate<decltype(keys)>("GALE::manifold_pairs", count);
    for (Offset v = 0; v < vertices; ++v) {
      if (numbers(v) != no_id) keys(numbers(v)) = {up.places(v), down.places(v), 0};
    }
    pairs = allocate<GlobalIds>("GALE::morse_smale_manifolds", vertices);
  });
  const detail::KeyPlaces found = detail::places_of_keys(mesh.ranks(), keys);
  parallel_for("GALE::morse_smale_manifolds", HostExecutionSpace(), vertices,
               [&](Offset v) { pairs(v) = numbers(v) == no_id ? -1 : found.places(numbers(v)); });
  complete(mesh, pairs);
  return {pairs, found.count};
}

}  // namespace

DistributedManifolds find_manifolds(const DistributedGradient& gradient) {
  DistributedManifolds manifolds;
  const Ends down = descending(gradient, manifolds.rounds), up = ascending(gradient, manifolds.rounds);
  manifolds.descending = down.places;
  manifolds.ascending = up.places;
  std::tie(manifolds.morse_smale, manifolds.morse_smale_manifolds) = find_pairs(gradient.mesh, up, down);
  return manifolds;
}

}  // namespace gale
