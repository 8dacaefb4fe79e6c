#pragma once

#include <gale/runtime/explicit/global_graph.hpp>

// What Kokkos-Kernels computes, in the workers' space. Where GALE was built without it, each of these throws
// gale::Error that says so.

namespace gale::detail {

void require_kokkos_kernels();

/// The coboundary XY from its faces YX: its transpose. Rows ascend. `rows`: how many X there are.
GlobalGraph transpose(Relation relation, const GlobalGraph& faces, Id rows);

/// The adjacency XX from XY and YX: which X share a Y, none of them with itself. Rows ascend. While it works it takes 4
/// bytes an entry, 16 a row and what Kokkos-Kernels hashes with beside the result. Throws gale::Error if it has more
/// entries than an Id counts, before it takes memory for them.
GlobalGraph neighbours(Relation relation, const GlobalGraph& xy, const GlobalGraph& yx);

}  // namespace gale::detail
