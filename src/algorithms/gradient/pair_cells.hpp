#pragma once

#include <gale/base/kokkos.hpp>

namespace gale::detail {

/// Pairs the cells of a vertex's lower star, but for the vertex and its edge of the smallest key, cell 0, which are a
/// pair already. It is homotopy expansion after Robins, Wood and Sheppard, "Theory and algorithms for constructing
/// discrete Morse complexes from grayscale digital images" (2011).
///
/// `queues` knows the star. `add_edges()` queues all but cell 0; `settle(cell)` says that it is paired or critical;
/// `push(cell)` queues its cofacets with exactly one unsettled facet; `next(cell)` takes the least unsettled one of
/// these; `facet(cell)` is the unsettled facet of such a cell, or -1 if it has none by now; `defer(cell)` queues a cell
/// that has none; `next_deferred(cell)` takes the least unsettled one of these and of the edges.
///
/// Calls pair(facet, cell) for each pair and critical(cell) for each cell that is left. For the
/// host alone where `queues` are.
GALE_CALLS_ANY
template <class Queues, class Pair, class Critical>
KOKKOS_FORCEINLINE_FUNCTION void pair_cells(Queues&& queues, const Pair& pair, const Critical& critical) {
  queues.add_edges();
  queues.settle(0);
  queues.push(0);
  int cell;
  while (true) {
    if (queues.next(cell)) {
      const int facet = queues.facet(cell);
      if (facet < 0) {
        queues.defer(cell);
        continue;
      }
      queues.settle(facet);
      queues.settle(cell);
      pair(facet, cell);
      queues.push(cell);
      queues.push(facet);
    } else if (queues.next_deferred(cell)) {
      queues.settle(cell);
      critical(cell);
      queues.push(cell);
    } else {
      return;
    }
  }
}

}  // namespace gale::detail
