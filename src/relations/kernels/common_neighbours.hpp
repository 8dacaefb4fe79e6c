#pragma once

#include <gale/mesh/simplices.hpp>

namespace gale::detail {

/// As many entries are looked through rather than bisected.
inline constexpr Id few_entries = 32;

/// The neighbours of a vertex that are higher than it, or those that are lower, ascending: the ends of consecutive
/// entries of edge_high or of lower_edges.
template <class Memory>
struct NeighbourList {
  bool higher;
  Id begin, end;

  KOKKOS_FUNCTION NeighbourList(const Simplices<Memory>& s, Id vertex, bool are_higher)
      : higher(are_higher),
        begin(higher ? s.edge_begin(vertex) : s.lower_begin(vertex)),
        end(higher ? s.edge_begin(vertex + 1) : s.lower_begin(vertex + 1)) {}

  KOKKOS_FUNCTION Id size() const { return end - begin; }

  KOKKOS_FUNCTION Id vertex(const Simplices<Memory>& s, Id i) const {
    return higher ? s.edge_high(i) : s.edge_low(s.lower_edges(i));
  }
};

/// Calls visit(v) for some vertices v after `low` and before `high`, ascending. All common neighbours of the vertices
/// `of`, none of which is between these, are among them. They are no more than the neighbours of any of `of`.
template <int count, class Memory, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_candidate(const Simplices<Memory>& s, const Id (&of)[count], Id low, Id high,
                                               const Visit& visit) {
  NeighbourList<Memory> shortest(s, of[0], of[0] <= low);
  for (int i = 1; i < count; ++i) {
    const NeighbourList<Memory> other(s, of[i], of[i] <= low);
    if (other.size() < shortest.size()) shortest = other;
  }
  Id i = shortest.begin;
  for (Id end = shortest.end; end - i > few_entries;) {  // to the last that isn't after `low`
    const Id middle = i + (end - i) / 2;
    if (shortest.vertex(s, middle) <= low) {
      i = middle;
    } else {
      end = middle;
    }
  }
  for (; i < shortest.end; ++i) {
    const Id v = shortest.vertex(s, i);
    if (v >= high) return;
    if (v > low) visit(v);
  }
}

}  // namespace gale::detail
