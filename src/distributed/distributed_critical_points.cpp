#include <algorithm>

#include <gale/algorithms/critical_points/classify.hpp>
#include <gale/algorithms/critical_points/collect.hpp>
#include <gale/distributed/distributed_critical_points.hpp>
#include <gale/distributed/exchange_plan.hpp>

namespace gale {

namespace {

using Flags = Array<std::uint8_t, HostMemory>;

/// Which of the vertices that this rank owns are on the surface, by local input id; of ghosts it says nothing.
template <class Space>
Flags owned_flags(const Space& space, const Mesh& mesh, const detail::VertexTypes& types) {
  const auto found = allocate<Array<std::uint8_t, MemoryOf<Space>>>("GALE::surface_flags", mesh.vertices());
  const Id* const input = mesh.vertex_input<MemoryOf<Space>>().data();
  parallel_for(
      "GALE::surface_flags", space, mesh.owned_vertices(),
      KOKKOS_LAMBDA(Offset v) { found(input[v]) = types.on_surface(static_cast<Id>(v)); });
  space.fence();
  return on_host(found);
}

/// The same of all that it holds, as owners say.
template <class Space>
Flags surface_flags(const Space& space, const DistributedMesh& mesh, const detail::VertexTypes& types) {
  Flags flags;
  detail::together(mesh.ranks(), [&] { flags = owned_flags(space, mesh.local(), types); });
  mesh.from_owners()(mesh.ranks(), flags.data(), flags.data());
  return flags;
}

/// Has ghosts on the surface tell their neighbours, as the sweep has owned vertices do.
template <class Space>
void tell_of_ghosts(const Space& space, const VertexOrder& order, const Flags& flags,
                    const detail::VertexTypes& types) {
  using Memory = MemoryOf<Space>;
  const Mesh& mesh = order.mesh();
  const Id owned = mesh.owned_vertices();
  if (owned == mesh.vertices()) return;
  const auto on_surface = in_memory<Memory>(flags);
  const auto encoded = mesh.encoded<Memory>();
  const Id* const input = mesh.vertex_input<Memory>().data();
  const std::uint64_t* const keys = order.keys_in<Memory>().data();
  parallel_for(
      "GALE::tell_of_ghosts", space, mesh.tetrahedra(), KOKKOS_LAMBDA(Offset t) {
        const Quad corners = encoded.tetrahedron(static_cast<Id>(t));
        for (int i = 3; i > 0 && corners[i] >= owned; --i) {
          const Id ghost = corners[i];
          if (!on_surface(input[ghost])) continue;
          for (int k = 0; k < i && corners[k] < owned; ++k)
            types.tell(corners[k], detail::VertexTypes::seen_from(keys, corners[k], ghost));
        }
      });
  space.fence();
}

/// From what a sweep of the owned vertices has found.
template <class Space>
DistributedCriticalPoints complete(const Space& space, const DistributedOrder& order,
                                   const detail::VertexTypes& types) {
  const DistributedMesh& mesh = order.mesh();
  const Flags flags = surface_flags(space, mesh, types);
  DistributedCriticalPoints all;
  CriticalPoints here;
  detail::together(mesh.ranks(), [&] {
    tell_of_ghosts(space, order.local(), flags, types);
    here = detail::collect(space, mesh.local(), types);
    for (const Id vertex : here.vertices) all.vertices.push_back(mesh.vertex_id(vertex));
  });
  all.types = std::move(here.types);
  all.on_surface = std::move(here.on_surface);
  std::copy(here.counts.begin(), here.counts.end(), all.counts.begin());
  mesh.ranks().sum(all.counts.data(), static_cast<int>(all.counts.size()));
  return all;
}

}  // namespace

DistributedCriticalPoints find_critical_points(Structure& structure, const DistributedOrder& order,
                                               const SweepOptions& options) {
  detail::TypeArrays<HostMemory> found;
  detail::together(order.mesh().ranks(), [&] { found = detail::classify_vertices(structure, order.local(), options); });
  const ThreadLimit limit(options.threads);
  return complete(HostSpace(), order, found.types());
}

DistributedCriticalPoints find_critical_points(const WorkerSpace& space, const DistributedOrder& order,
                                               const DeviceSweepOptions& options) {
  detail::TypeArrays<detail::MemoryOfSweep<WorkerSpace>> found;
  detail::together(order.mesh().ranks(), [&] { found = detail::classify_vertices(space, order.local(), options); });
  return complete(space, order, found.types());
}

}  // namespace gale
