#pragma once

#include <array>
#include <vector>

#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/persistence/cancel_saddles.hpp>
#include <gale/algorithms/persistence/filtration.hpp>

namespace gale::detail {

/// What is cancelled of a gradient, and the gradient that this makes of it.
struct Cancellations {
  explicit Cancellations(const DiscreteGradient& gradient);

  std::array<std::vector<char>, 4> is_left;  ///< of each critical simplex, by dimension
  TurnedForest minima, maxima;
  std::vector<Id> heir_of_minimum, heir_of_maximum;  ///< the extremum whose manifold its own is part of; no_id for none
  TurnedEdges edges;
  CancelledSaddles saddles;
  KeptBelow kept_below;
};

/// Does what `simplify` says. `want_joined` as in `cancel_saddles`.
Cancellations cancel_below(double threshold, const MorseSmaleComplex& complex, const CriticalValues& values,
                           bool extrema_only, bool want_joined, int threads);

}  // namespace gale::detail
