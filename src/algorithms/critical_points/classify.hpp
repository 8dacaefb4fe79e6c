#pragma once

#include <gale/algorithms/critical_points.hpp>
#include <gale/algorithms/critical_points/vertex_types.hpp>
#include <gale/runtime/device_sweep.hpp>

namespace gale::detail {

/// The arrays that VertexTypes is a view of, by GALE's vertex id. Entries of ghosts say nothing.
template <class Memory>
struct TypeArrays {
  Array<std::uint8_t, Memory> own, told;

  VertexTypes types() const { return {own.data(), told.data()}; }
};

/// The sweeps of find_critical_points: each vertex's type by its own link, and what its neighbours told it.
TypeArrays<HostMemory> classify_vertices(Structure& structure, const VertexOrder& order, const SweepOptions& options);
TypeArrays<MemoryOfSweep<WorkerSpace>> classify_vertices(const WorkerSpace& space, const VertexOrder& order,
                                                         const DeviceSweepOptions& options);

}  // namespace gale::detail
