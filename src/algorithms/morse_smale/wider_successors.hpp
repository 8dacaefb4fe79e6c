#pragma once

#include <utility>

#include <gale/algorithms/discrete_gradient.hpp>

namespace gale::detail {

/// The successors of a part's cells, and of others, whose numbers come after them. Those that the part lacks are said
/// beside it. Owns nothing.
struct WiderSuccessors {
  const Id* own;
  Id count;
  const Id* beyond = nullptr;                ///< of others
  const std::pair<Id, Id>* exits = nullptr;  ///< own cells whose successors are elsewhere, ascending, and these
  Id exit_count = 0;

  KOKKOS_FUNCTION Id operator[](Id cell) const {
    if (cell >= count) return beyond[cell - count];
    const Id next = own[cell];
    return next == DiscreteGradient::elsewhere ? next_of_exit(cell) : next;
  }

 private:
  KOKKOS_FUNCTION Id next_of_exit(Id cell) const {
    Id low = 0, high = exit_count;
    while (low < high) {
      const Id middle = low + (high - low) / 2;
      if (exits[middle].first == cell) return exits[middle].second;
      if (exits[middle].first < cell) {
        low = middle + 1;
      } else {
        high = middle;
      }
    }
    return DiscreteGradient::elsewhere;
  }
};

}  // namespace gale::detail
