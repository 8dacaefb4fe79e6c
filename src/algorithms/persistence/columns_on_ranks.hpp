#pragma once

#include <vector>

#include <gale/algorithms/persistence/saddle_columns.hpp>
#include <gale/mesh/exchange/messages.hpp>

namespace gale::detail {

/// What the first rank knows of the saddles of all ranks: places by rank and by places on that rank.
struct GatheredSaddles {
  EntriesByRank<Id> edges, triangles;  ///< the place of each rank's critical edges and triangles among all
  const Filtration& filtration;        ///< of all
};

/// Goes on with columns that several ranks have begun, each with those of its own 2-saddles. Returns for each 1-saddle
/// of all ranks the 2-saddle that it is paired with, on the first rank; nothing on the others.
///
/// What one rank has paired stays, unless a column that stopped between ranks comes to the same 1-saddle. So these
/// alone, and the columns that they can come to, fall to their ends: each rank follows what is in its part, and tells
/// the others which edges of a column leave it. The first rank gets the critical edges of these columns, and
/// eliminates. Collective, in as many rounds of messages as a rim changes ranks.
std::vector<Id> finish_on_ranks(const DiscreteGradient& gradient, const CriticalPlaces& places,
                                const SaddleColumns& columns, const Filtration& own, const GatheredSaddles& all);

}  // namespace gale::detail
