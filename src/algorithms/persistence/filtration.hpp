#pragma once

#include <array>
#include <vector>

#include <gale/algorithms/discrete_gradient.hpp>

namespace gale::detail {

/// The critical simplices of a gradient in the order in which the mesh is built up: each dimension by the keys of its
/// simplices' vertices, from the highest to the lowest.
struct Filtration {
  std::array<std::vector<Id>, 4> by_rank;  ///< places in CriticalSimplices
  std::array<std::vector<Id>, 4> rank;     ///< of each place
};

Filtration filtration_of(const DiscreteGradient& gradient, int threads);

/// A tetrahedron's vertices from the highest to the lowest.
std::array<Id, 4> from_highest(const DiscreteGradient& gradient, Id tetrahedron);

}  // namespace gale::detail
