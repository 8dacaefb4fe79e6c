#pragma once

#include <gale/mesh/input_numbers.hpp>

// The two ways to the `input_numbers` of edges, triangles or both; there are none of what isn't wanted. They need the
// tables up to these.

namespace gale::detail {

/// Numbers on the host's threads: each vertex those simplices of which it has the least input id, from its neighbours
/// alone, so that nothing is sorted that lies far apart. Time O(n); O(n log n) at vertices that have more than 16 such
/// neighbours.
MadeNumbers number_by_vertex(const Simplices<HostMemory>& simplices, const Borrowed<Id, HostMemory>& vertex_input,
                             bool edges, bool triangles);

/// Numbers by sorting all: what a device does. Time O(n), O(n log n) at vertices and edges of very many; 16 bytes each
/// meanwhile.
template <class Space>
MadeNumbers number_by_sorting(const Space& space, const Simplices<MemoryOf<Space>>& simplices,
                              const Borrowed<Id, MemoryOf<Space>>& vertex_input, bool edges, bool triangles);

}  // namespace gale::detail
