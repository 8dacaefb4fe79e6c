#pragma once

#include <cstddef>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/excerpt/reached.hpp>

namespace gale::detail {

/// What of a gradient a rank needs that lies on several: a gradient of a small mesh of its own, on this rank alone, of
/// the simplices that ways along the other one reach. Its simplices have the global ids, and its order is the same; so
/// what algorithms find in it along these ways is what they would find in the whole. All else there is nothing of.
///
/// Makes one for each rank, as `reach` does; it is empty where nothing was asked for. Collective.
DiscreteGradient excerpt_of(const DiscreteGradient& gradient, const WantedWays& ways, Structure* rows = nullptr,
                            std::size_t most_bytes = 0);

/// Makes one of all that critical simplices reach on the first rank, as `gather_gradient` does; with rising walls, too,
/// where these are wanted. Collective.
DiscreteGradient gathered_with_walls(const DiscreteGradient& gradient, bool rising_walls, std::size_t most_bytes = 0);

}  // namespace gale::detail
