#pragma once

#include <gale/mesh/input_numbers.hpp>
#include <gale/mesh/number_by_sorting.hpp>

namespace gale::detail {

/// The `input_numbers` of edges, triangles or both on the host's threads, which need the tables up to these; of what
/// isn't wanted there are none. Each vertex numbers those simplices of which it has the least input id, from its
/// neighbours alone: nothing is sorted that lies far apart. Time O(n); O(n log n) at vertices that have more than 16
/// such neighbours.
InputNumbers number_by_vertex(const Simplices<HostMemory>& simplices, const VertexInput<HostMemory>& input, bool edges,
                              bool triangles);

}  // namespace gale::detail
