#include <algorithm>

#include <gale/algorithms/critical_points/classify.hpp>
#include <gale/algorithms/critical_points/collect.hpp>
#include <gale/distributed/distributed_critical_points.hpp>
#include <gale/distributed/exchange_plan.hpp>

namespace gale {

namespace {

template <class Space>
using Flags = Array<std::uint8_t, MemoryOf<Space>>;

/// Which of the vertices that others have as ghosts are on the surface, in the order in which they are told.
template <class Space>
Flags<HostExecutionSpace> told_flags(const Space& space, const DistributedMesh& mesh,
                                     const detail::VertexTypes& types) {
  const Array<Id, MemoryOf<Space>> places = in_memory<MemoryOf<Space>>(mesh.from_owners().given_places());
  const auto flags = allocate<Flags<Space>>("GALE::surface_flags", places.extent(0));
  const Id* const internal = mesh.local().vertex_internal<MemoryOf<Space>>().data();
  parallel_for(
      "GALE::surface_flags", space, places.extent(0),
      KOKKOS_LAMBDA(Offset i) { flags(i) = types.on_surface(internal[places(i)]); });
  space.fence();
  return on_host(flags);
}

/// Which of this rank's ghosts are on the surface, as their owners say; from the first one on.
template <class Space>
Flags<Space> ghost_flags(const Space& space, const DistributedMesh& mesh, const detail::VertexTypes& types) {
  Flags<HostExecutionSpace> told;
  detail::together(mesh.ranks(), [&] { told = told_flags(space, mesh, types); });
  const auto fetched = mesh.from_owners().fetch(mesh.ranks(), told);
  Flags<Space> flags;
  detail::together(mesh.ranks(), [&] {
    const Id owned = mesh.local().owned_vertices();
    flags = allocate<Flags<Space>>("GALE::ghost_flags", mesh.local().vertices() - owned);
    const Id* const internal = mesh.local().vertex_internal<MemoryOf<Space>>().data();
    const Array<Id, MemoryOf<Space>> slots = in_memory<MemoryOf<Space>>(mesh.from_owners().slots());
    const Flags<Space> values = in_memory<MemoryOf<Space>>(fetched.entries);
    const Flags<Space> to = flags;
    parallel_for(
        "GALE::ghost_flags", space, slots.extent(0),
        KOKKOS_LAMBDA(Offset i) { to(internal[slots(i)] - owned) = values(i); });
    space.fence();
  });
  return flags;
}

/// Has ghosts on the surface tell their neighbours, as the sweep has owned vertices do.
template <class Space>
void tell_of_ghosts(const Space& space, const VertexOrder& order, const Flags<Space>& on_surface,
                    const detail::VertexTypes& types) {
  using Memory = MemoryOf<Space>;
  const Mesh& mesh = order.mesh();
  const Id owned = mesh.owned_vertices();
  if (owned == mesh.vertices()) return;
  const auto encoded = mesh.encoded<Memory>();
  const std::uint64_t* const keys = order.keys_in<Memory>().data();
  parallel_for(
      "GALE::tell_of_ghosts", space, mesh.tetrahedra(), KOKKOS_LAMBDA(Offset t) {
        const Quad corners = encoded.tetrahedron(static_cast<Id>(t));
        for (int i = 3; i > 0 && corners[i] >= owned; --i) {
          const Id ghost = corners[i];
          if (!on_surface(ghost - owned)) continue;
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
  const Flags<Space> flags = ghost_flags(space, mesh, types);
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
  return complete(HostExecutionSpace(), order, found.types());
}

DistributedCriticalPoints find_critical_points(const WorkerSpace& space, const DistributedOrder& order,
                                               const DeviceSweepOptions& options) {
  detail::TypeArrays<detail::MemoryOfSweep<WorkerSpace>> found;
  detail::together(order.mesh().ranks(), [&] { found = detail::classify_vertices(space, order.local(), options); });
  return complete(space, order, found.types());
}

}  // namespace gale
