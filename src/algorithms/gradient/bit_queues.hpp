#pragma once

#include <gale/base/kokkos.hpp>

namespace gale::detail {

/// The queues of `pair_cells` for a LowerStar: sets of bits, the lowest of which is the head.
template <class Star>
class BitQueues {
 public:
  KOKKOS_FORCEINLINE_FUNCTION explicit BitQueues(const Star& star) : star_(star) {}

  KOKKOS_FORCEINLINE_FUNCTION void add_edges() { deferred_ = star_.all_edges(); }
  KOKKOS_FORCEINLINE_FUNCTION void settle(int cell) { settled_.add(cell); }

  KOKKOS_FORCEINLINE_FUNCTION void push(int cell) {
    for (Cells rest = star_.cofacets(cell) - settled_; !rest.empty(); rest.remove_lowest()) {
      const int cofacet = rest.lowest();
      if ((star_.facets(cofacet) - settled_).is_single()) ready_.add(cofacet);
    }
  }

  KOKKOS_FORCEINLINE_FUNCTION bool next(int& cell) { return take(ready_, cell); }
  KOKKOS_FORCEINLINE_FUNCTION bool next_deferred(int& cell) { return take(deferred_, cell); }
  KOKKOS_FORCEINLINE_FUNCTION void defer(int cell) { deferred_.add(cell); }

  KOKKOS_FORCEINLINE_FUNCTION int facet(int cell) const {
    const Cells left = star_.facets(cell) - settled_;
    return left.empty() ? -1 : left.lowest();
  }

 private:
  using Cells = typename Star::Cells;

  KOKKOS_FORCEINLINE_FUNCTION bool take(Cells& from, int& cell) {
    from -= settled_;
    if (from.empty()) return false;
    cell = from.lowest();
    from.remove_lowest();
    return true;
  }

  const Star& star_;
  Cells settled_ = Cells::none();
  Cells ready_ = Cells::none();
  Cells deferred_ = Cells::none();
};

}  // namespace gale::detail
