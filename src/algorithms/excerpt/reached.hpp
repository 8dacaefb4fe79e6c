#pragma once

#include <array>
#include <tuple>
#include <vector>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/excerpt/received_numbers.hpp>
#include <gale/algorithms/gradient/edge_pairs.hpp>
#include <gale/mesh/exchange/messages.hpp>
#include <gale/runtime/structure.hpp>

// What critical simplices of a gradient reach that lies on several ranks, found by all of them for those who ask.

namespace gale::detail {

/// Which ways along a gradient to follow from critical simplices, and for whom.
struct WantedWays {
  bool all_for_first = false;  ///< from those of all ranks, for the first one; else for each rank from its own
  bool falling_paths = false;  ///< down from critical edges
  bool rising_paths = false;   ///< up from critical facets of cells
  bool falling_walls = false;  ///< down from critical triangles
  bool rising_walls = false;   ///< up from critical edges, with all cells around
};

/// What stands for a cell's successor that is outside: behind the corner opposite the facet that it is paired with.
constexpr Id step_outside(int corner) { return -2 - corner; }
constexpr int corner_of_step(Id step) { return -2 - step; }

/// What was reached, as `List<T>`s: simplices are called by places in the lists of vertices and cells.
template <template <class> class List>
struct ReachedLists {
  List<ReceivedVertex> vertices;
  List<ReceivedCell> cells;
  List<std::array<Id, 2>> vertex_steps;        ///< a vertex, and the next one; no_id: it is critical
  List<std::array<Id, 3>> edges;               ///< an edge, the higher end first, and what it is paired with
  List<std::array<Id, 2>> cell_steps;          ///< a cell, and the next one; no_id: it is critical
  List<std::array<Id, 2>> cell_forks;          ///< a cell, and one more that follows it
  List<std::array<Id, 3>> critical_triangles;  ///< from the highest vertex to the lowest
  List<std::array<Id, 4>> critical_stars;      ///< a critical facet of cells, an edge with no_id behind it, and a cell

  /// Refers to all of these lists.
  auto all() { return all_of(*this); }
  auto all() const { return all_of(*this); }

 private:
  template <class Lists>
  static auto all_of(Lists& of) {
    return std::tie(of.vertices, of.cells, of.vertex_steps, of.edges, of.cell_steps, of.cell_forks,
                    of.critical_triangles, of.critical_stars);
  }
};

/// What one rank has received, by the rank that found it: places are those among what that one sent.
using Reached = ReachedLists<EntriesByRank>;

/// Follows ways, from rank to rank in rounds of messages, as many as a way changes ranks: a step is taken by the rank
/// that owns the highest vertex of a simplex. Each is taken once for each rank that asks. `rows` has VT, for rising
/// walls alone. Collective. Throws gale::Error on all ranks, before anything is sent, if one would receive more than
/// `most_bytes`; 0 stands for its share of what its machine has left.
Reached reach(const DiscreteGradient& gradient, const WantedWays& ways, Structure* rows, std::size_t most_bytes);

}  // namespace gale::detail
