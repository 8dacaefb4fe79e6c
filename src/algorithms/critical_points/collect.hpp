#pragma once

#include <gale/algorithms/critical_points/vertex_types.hpp>

namespace gale::detail {

/// The owned vertices that aren't regular, from types that a sweep of these has left in the memory of `space`, and the
/// counts of all ranks. Collective: ghosts on the surface tell their neighbours, too, as their owners say.
template <class Space>
CriticalPoints collect(const Space& space, const VertexOrder& order, const VertexTypes& types);

}  // namespace gale::detail
