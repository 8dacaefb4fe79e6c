#pragma once

#include <array>
#include <utility>
#include <vector>

#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/morse_smale/critical_places.hpp>
#include <gale/algorithms/persistence/pairs.hpp>
#include <gale/algorithms/persistence/turned_gradient.hpp>

namespace gale::detail {

/// 1-saddles and 2-saddles that are to be cancelled with each other, as far as that is possible.
struct DoomedSaddles {
  std::vector<PersistencePair> pairs;  ///< by ascending persistence
  std::vector<double> lower, upper;    ///< the value of each 1-saddle and each 2-saddle of the gradient
  std::vector<double> minimum_below;   ///< the value of the minimum that a 1-saddle was cancelled with
  double threshold;                    ///< a pair that is cancelled differs by less
};

struct CancelledSaddles {
  std::vector<PersistencePair> pairs;  ///< in turn

  /// 1-saddles that were cancelled with a minimum instead of others, in turn: those are among `pairs`.
  std::vector<std::pair<Id, Id>> exchanged;

  /// If wanted, for each 1-saddle those that it had a path to the 2-saddle of when they were cancelled: its ascending
  /// wall goes on in theirs.
  std::vector<std::vector<Id>> joined;

  KeptBelow kept;
};

/// Cancels them, and turns the paths between them around in `turned`.
///
/// First each pair, if one path leads from one to the other; then any two of what is left, if one path does, the least
/// difference first. How many paths there are is counted in a graph, generously; where nothing is left to cancel the
/// walls of the 2-saddles tell. At last a 1-saddle that is left may be cancelled with a minimum, if that sets another
/// one free that can be cancelled with a 2-saddle that is left. No pair of which the 1-saddle is higher is cancelled.
///
/// `minima` and `turned` are those of a gradient whose minima were cancelled before.
CancelledSaddles cancel_saddles(const MorseSmaleComplex& complex, const CriticalPlaces& places,
                                const DoomedSaddles& doomed, bool want_joined, TurnedForest& minima,
                                TurnedEdges& turned);

/// What is cancelled of a gradient, and the gradient that this makes of it.
struct Cancellations {
  explicit Cancellations(const DiscreteGradient& gradient);

  PersistencePairs pairs;                    ///< that there are; with `extrema_only` those of extrema
  std::array<std::vector<char>, 4> is_left;  ///< of each critical simplex, by dimension
  TurnedForest minima, maxima;
  std::vector<Id> heir_of_minimum, heir_of_maximum;  ///< the extremum whose manifold its own is part of; no_id for none
  TurnedEdges edges;
  CancelledSaddles saddles;
};

/// Does what `simplify` says. `want_joined` as in `cancel_saddles`.
Cancellations cancel_below(double threshold, const MorseSmaleComplex& complex, const CriticalValues& values,
                           bool extrema_only, bool want_joined, int threads);

}  // namespace gale::detail
