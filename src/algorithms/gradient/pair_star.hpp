#pragma once

#include <array>

#include <gale/algorithms/gradient/edge_pairs.hpp>
#include <gale/algorithms/gradient/lower_star.hpp>
#include <gale/base/kokkos.hpp>
#include <gale/relations/rows.hpp>

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

/// The successor of a tetrahedron that leaves through the surface, by the triangle opposite its corner.
KOKKOS_INLINE_FUNCTION Id outside(int corner) { return no_id - 1 - corner; }

/// That corner.
KOKKOS_INLINE_FUNCTION int corner_outside(Id successor) { return no_id - 1 - successor; }

/// The successor of the tetrahedron at `place`, which is paired with its triangle (vertex, a, b) on the surface.
KOKKOS_INLINE_FUNCTION Id surface_successor(const VertexStar& star, Id place, Id a, Id b) {
  for (int corner = 0; corner < 3; ++corner) {
    const Id other = star.neighbours[star.link(place, corner)];
    if (other != a && other != b) return outside(corner + (other > star.vertex ? 1 : 0));
  }
  return no_id;
}

/// Pairs the lower star of a vertex, a VertexStar or what says the same, and puts what it finds into `sink`. `lower`
/// are its lower neighbours, `cells` the lower star, `queues` are for pair_cells. For the host alone where these are.
GALE_CALLS_ANY
template <class Sink, class Star, class Lower, class Cells, class Queues>
KOKKOS_FORCEINLINE_FUNCTION void pair_star(const Sink& sink, const Star& star, const Lower& lower, const Cells& cells,
                                           Queues&& queues) {
  const auto id = [&](int rank) { return star.neighbours[lower.place(lower.with_rank(rank))]; };
  EdgePairRow edges = sink.begin_edges(star.vertex, lower.count());
  for (int i = 0; i < lower.count(); ++i) edges.set_id(i, star.neighbours[lower.place(i)]);
  sink.set_vertex(star.vertex, lower.count() == 0 ? no_id : id(0));
  if (lower.count() == 0) return;
  const auto pair = [&](int facet, int cell) {
    const auto low = cells.corners(facet);
    if (cells.dimension(cell) == 2) {
      const auto both = cells.corners(cell);
      edges.pair(lower.with_rank(low[0]), lower.with_rank(both[0] == low[0] ? both[1] : both[0]));
    } else {
      const Id place = cells.place(cell), across = cells.across(facet, place);
      if constexpr (Cells::may_leave) {
        sink.set_cell(star.cells[place], across == Cells::no_place
                                             ? surface_successor(star, place, id(low[0]), id(low[1]))
                                             : star.cells[across]);
      } else {
        sink.set_cell(star.cells[place], star.cells[across]);
      }
      if constexpr (Cells::may_fork) {
        cells.for_each_place(facet, [&](Id other) {
          if (other != place && other != across) sink.add_successor(star.cells[place], star.cells[other]);
        });
      }
    }
  };
  const auto critical = [&](int cell) {
    const auto corners = cells.corners(cell);
    const int dimension = cells.dimension(cell);
    if (dimension == 1) {
      sink.add_critical_edge(star.vertex, id(corners[0]));
    } else if (dimension == 3) {
      sink.add_critical_cell(star.cells[cells.place(cell)]);
    } else {
      const std::array<Id, 3> triangle = {star.vertex, id(corners[0]), id(corners[1])};
      sink.add_critical_triangle(triangle);
      cells.for_each_place(cell, [&](Id place) { sink.add_to_star(triangle, star.cells[place]); });
    }
  };
  pair_cells(queues, pair, critical);
}

/// Pairs a star by sets of so many words; false if it is too large.
GALE_CALLS_ANY
template <int Words, bool is_small, class Sink>
KOKKOS_FUNCTION bool pair_star_of_words(const Sink& sink, const VertexStar& star, const LowerNeighbours& lower) {
  using Star = LowerStar<Words, is_small>;
  Star cells;
  if (!cells.build(lower, star.link)) return false;
  pair_star(sink, star, lower, cells, BitQueues<Star>(cells));
  return true;
}

}  // namespace gale::detail
