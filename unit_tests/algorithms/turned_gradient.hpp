#pragma once

#include <vector>

#include "algorithms/brute_force_gradient.hpp"

namespace gale::test {

/// A gradient as pairs of simplices, of which pairs of critical simplices are cancelled one after the other, by the
/// definition (Forman 1998): the only path between the two is turned around. A test that cancels two between which
/// there isn't exactly one path fails.
class TurnedGradient {
 public:
  TurnedGradient(const CellsOf& mesh, const std::vector<double>& field, const BruteForceGradient& gradient);

  const BruteForceGradient& gradient() const { return gradient_; }

  /// Cancels two critical simplices.
  void cancel(const Simplex& lower, const Simplex& upper);

  /// Cancels 1-saddles with minima, the lowest saddle first, each with the higher one of the two minima that its paths
  /// lead to.
  void cancel_with_minima(std::vector<Simplex> saddles);

  /// Cancels from the highest saddle below maxima down with the lower one of the two maxima; the outside is above all.
  void cancel_with_maxima(std::vector<Simplex> saddles);

 private:
  std::vector<Id> key(const Simplex& simplex) const;
  bool is_below(const Simplex& a, const Simplex& b) const { return key(a) < key(b); }
  Simplex partner(const Simplex& simplex, std::size_t size) const;
  Simplex minimum_from(Id vertex) const;
  Simplex maximum_from(Simplex cell) const;

  BruteForceGradient gradient_;
  std::vector<Id> rank_;
  std::map<Simplex, std::vector<Simplex>> cells_of_;  ///< of each facet of cells
};

}  // namespace gale::test
