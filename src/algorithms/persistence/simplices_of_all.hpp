#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <gale/algorithms/persistence/pairs.hpp>
#include <gale/mesh/exchange/messages.hpp>

namespace gale::detail {

/// A critical simplex as the first rank gets it.
struct SentSimplex {
  std::array<GlobalId, 3> name;  ///< what CriticalSimplices are sorted by: its vertices, ascending, or the cell
  std::uint64_t value;           ///< of its highest vertex, as VertexOrder::value_key
  Id rank;                       ///< in its own rank's filtration
  Id place_of_highest;           ///< of that vertex in `name`, where a cell has it behind its own number

  GlobalId highest() const { return name[place_of_highest]; }
};

/// This rank's critical simplices, by dimension, each in the order of its names. `filtration` has their ranks.
std::array<std::vector<SentSimplex>, 4> simplices_to_send(const DiscreteGradient& gradient,
                                                          const Filtration& filtration);

/// The highest vertex that this rank owns, as it is sent; none where it owns none.
std::vector<SentSimplex> highest_to_send(const DiscreteGradient& gradient);

/// Critical simplices of one dimension of all ranks, on the first one.
struct SimplicesOfAll {
  EntriesByRank<SentSimplex> sent;
  EntriesByRank<Id> place;    ///< of each
  std::vector<Id> from_rank;  ///< by rank in the filtration: the entry

  explicit SimplicesOfAll(EntriesByRank<SentSimplex> from);
};

}  // namespace gale::detail
