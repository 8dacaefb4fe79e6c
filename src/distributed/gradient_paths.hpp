#pragma once

#include <gale/distributed/distributed_gradient.hpp>
#include <gale/distributed/distributed_paths.hpp>

namespace gale::detail {

/// The simplices that falling paths of a gradient lead through, and rising ones. They refer to it.
PathSimplices falling_simplices(const DistributedGradient& gradient);
PathSimplices rising_simplices(const DistributedGradient& gradient);

}  // namespace gale::detail
