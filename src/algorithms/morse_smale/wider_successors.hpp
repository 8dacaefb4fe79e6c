#pragma once

#include <utility>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/base/ordered.hpp>

namespace gale::detail {

/// The successors of simplices that a rank knows: of a part's own ones, and of others, whose numbers come after them.
/// An own one that the part says is elsewhere is looked up among the exits. Owns nothing.
struct WiderSuccessors {
  const Id* own;
  Id count;                                  ///< of own ones
  const Id* beyond = nullptr;                ///< of the others
  const std::pair<Id, Id>* exits = nullptr;  ///< own ones, ascending, and their successors
  Id exit_count = 0;

  /// Elsewhere where nobody has told it.
  KOKKOS_FUNCTION Id operator[](Id simplex) const {
    if (simplex >= count) return beyond[simplex - count];
    const Id next = own[simplex];
    return next == DiscreteGradient::elsewhere ? next_of_exit(simplex) : next;
  }

 private:
  KOKKOS_FUNCTION Id next_of_exit(Id simplex) const {
    const auto* const from = exits;
    const Id at = bisect(Id(0), exit_count, [=](Id i) { return from[i].first < simplex; });
    return at < exit_count && exits[at].first == simplex ? exits[at].second : DiscreteGradient::elsewhere;
  }
};

/// Brings a successor that is soon read near.
inline void bring_near(const WiderSuccessors& successors, Id simplex) {
  if (simplex < successors.count) __builtin_prefetch(successors.own + simplex);
}

}  // namespace gale::detail
