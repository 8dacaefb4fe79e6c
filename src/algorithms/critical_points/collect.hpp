#pragma once

#include <algorithm>
#include <vector>

#include <gale/algorithms/critical_points/vertex_types.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

template <class T, class View>
std::vector<T> to_host_vector(const View& view) {
  const auto there = on_host(view);
  std::vector<T> values(there.extent(0));
  std::transform(there.data(), there.data() + there.extent(0), values.begin(),
                 [](auto value) { return static_cast<T>(value); });
  return values;
}

/// 1 for an input vertex that isn't regular, nor a ghost.
struct IsCritical {
  const Id* internal;
  VertexTypes types;
  Id owned;

  KOKKOS_FUNCTION bool operator()(Offset i) const {
    return internal[i] < owned && types.type(internal[i]) != CriticalType::regular;
  }
};

/// Writes what is said of such a vertex to its place.
template <class Memory>
struct WriteCritical {
  const Id* internal;
  VertexTypes types;
  Array<Id, Memory> place, vertices;
  Array<std::uint8_t, Memory> their_types, on_surface;

  KOKKOS_FUNCTION void operator()(Offset i) const {
    const Id at = place(i);
    if (place(i + 1) == at) return;
    vertices(at) = static_cast<Id>(i);
    their_types(at) = static_cast<std::uint8_t>(types.type(internal[i]));
    on_surface(at) = types.on_surface(internal[i]);
  }
};

/// The vertices that aren't regular, from types that lie in the memory of `space`; of ghosts none.
template <class Space>
CriticalPoints collect(const Space& space, const Mesh& mesh, const VertexTypes& types) {
  using Bytes = Array<std::uint8_t, MemoryOf<Space>>;
  using Ids = Array<Id, MemoryOf<Space>>;
  const Offset count = mesh.vertices();
  const Id* const internal = mesh.vertex_internal<MemoryOf<Space>>().data();
  const Id owned = mesh.owned_vertices();
  const auto place = allocate<Ids>("GALE::critical_place", count + 1);
  const Id total = exclusive_scan("GALE::count_critical", space, count, place, IsCritical{internal, types, owned});
  const auto vertices = allocate<Ids>("GALE::critical_vertices", total);
  const auto their_types = allocate<Bytes>("GALE::critical_types", total),
             on_surface = allocate<Bytes>("GALE::critical_on_surface", total);
  parallel_for("GALE::collect_critical", space, count,
               WriteCritical<MemoryOf<Space>>{internal, types, place, vertices, their_types, on_surface});
  space.fence();
  CriticalPoints points;
  points.vertices = to_host_vector<Id>(vertices);
  points.types = to_host_vector<CriticalType>(their_types);
  points.on_surface = to_host_vector<std::uint8_t>(on_surface);
  for (const CriticalType type : points.types) ++points.counts[static_cast<int>(type)];
  return points;
}

}  // namespace gale::detail
