#pragma once

#include <gale/base/memory.hpp>
#include <gale/mesh/simplices.hpp>

namespace gale::detail {

/// GALE's vertex -> input vertex. Of the mesh, which other threads may use too: a managed View's count isn't atomic
/// where Kokkos has Serial alone.
template <class Memory>
using VertexInput = Kokkos::View<const Id*, Memory, Kokkos::MemoryUnmanaged>;

/// The `input_numbers` of all edges (triangles) by sorting them: what a device does. Time O(n), O(n log n) at vertices
/// and edges of very many; 16 bytes each meanwhile.
template <class Space>
Array<Id, MemoryOf<Space>> sort_edges(const Space& space, const Simplices<MemoryOf<Space>>& simplices,
                                      const VertexInput<MemoryOf<Space>>& input);
template <class Space>
Array<Id, MemoryOf<Space>> sort_triangles(const Space& space, const Simplices<MemoryOf<Space>>& simplices,
                                          const VertexInput<MemoryOf<Space>>& input);

}  // namespace gale::detail
