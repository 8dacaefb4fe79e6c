#pragma once

#include <vector>

#include <gale/algorithms/morse_smale/critical_places.hpp>
#include <gale/algorithms/persistence/filtration.hpp>

namespace gale::detail {

/// Pairs 1-saddles with 2-saddles: for each 1-saddle the 2-saddle that it is paired with, no_id if it is with none.
/// `columns` are the 2-saddles to pair, in the order of the filtration: those that no maximum is paired with.
///
/// Elimination by columns. Each 2-saddle's rim falls until its highest edge is a 1-saddle (EdgeChain). If an earlier
/// 2-saddle has met that one, its rim is added, and both fall on; if a later one has, that one goes on instead, with
/// both rims (Morozov, Nigmetov, "Towards lockfree persistent homology", 2020). So threads needn't wait for each other,
/// and the pairs are the same whatever their number.
std::vector<Id> pair_saddles(const DiscreteGradient& gradient, const CriticalPlaces& places,
                             const Filtration& filtration, const std::vector<Id>& columns, int threads);

}  // namespace gale::detail
