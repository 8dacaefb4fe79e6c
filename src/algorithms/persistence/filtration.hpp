#pragma once

#include <array>
#include <functional>
#include <vector>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/persistence.hpp>

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

/// The value of each critical simplex of a gradient, which is that of its highest vertex, by dimension.
using CriticalValues = std::array<std::vector<double>, 4>;

/// `value(v)` is the field at an input vertex. Throws gale::Error, naming the vertex, if it is NaN.
CriticalValues critical_values(const DiscreteGradient& gradient, const std::function<double(Id)>& value);

/// The difference of two values, which may be infinite.
inline double persistence_of(double low, double high) { return low == high ? 0 : high - low; }

/// The pairs of a type whose persistence is below a threshold, the least persistent first; of equals that of the first
/// lower simplex.
std::vector<PersistencePair> pairs_below(double threshold, int type, const std::vector<PersistencePair>& pairs,
                                         const CriticalValues& values);

}  // namespace gale::detail
