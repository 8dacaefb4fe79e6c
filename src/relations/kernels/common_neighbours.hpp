#pragma once

#include <gale/mesh/simplices.hpp>

namespace gale::detail {

/// The first place in values[begin] to values[end - 1], which ascend, of one that is at least `value`; `end` if all are
/// less.
template <class Values>
KOKKOS_INLINE_FUNCTION Id first_at_least(const Values& values, Id begin, Id end, Id value) {
  while (begin < end) {
    const Id middle = begin + (end - begin) / 2;
    if (values(middle) < value) {
      begin = middle + 1;
    } else {
      end = middle;
    }
  }
  return begin;
}

/// Neighbours of one vertex that all are higher than it, or all lower: the ends of consecutive entries of edge_high or
/// of lower_edges.
struct NeighbourRange {
  bool higher;
  Id begin, end;

  KOKKOS_FUNCTION Id size() const { return end - begin; }

  template <class Memory>
  KOKKOS_FUNCTION Id vertex(const Simplices<Memory>& s, Id i) const {
    return higher ? s.edge_high(i) : s.edge_low(s.lower_edges(i));
  }
};

/// The neighbours of a vertex after `low` and before `high`. It is not between these itself.
template <class Memory>
KOKKOS_INLINE_FUNCTION NeighbourRange neighbours_between(const Simplices<Memory>& s, Id vertex, Id low, Id high) {
  if (vertex <= low) {
    const Id end = s.edge_begin(vertex + 1);
    const Id begin = first_at_least(s.edge_high, s.edge_begin(vertex), end, low + 1);
    return {true, begin, first_at_least(s.edge_high, begin, end, high)};
  }
  const Id end = s.lower_begin(vertex + 1);
  const Id begin = first_at_least(s.lower_edges, s.lower_begin(vertex), end, s.edge_begin(low + 1));
  return {false, begin, first_at_least(s.lower_edges, begin, end, s.edge_begin(high))};
}

/// Calls visit(v) for some vertices v after `low` and before `high`, ascending. All common neighbours of the vertices
/// `of`, none of which is between these, are among them. They are as few as the one has that has the fewest.
template <int count, class Memory, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_candidate(const Simplices<Memory>& s, const Id (&of)[count], Id low, Id high,
                                               const Visit& visit) {
  NeighbourRange fewest = neighbours_between(s, of[0], low, high);
  for (int i = 1; i < count && fewest.size() > 0; ++i) {
    const NeighbourRange other = neighbours_between(s, of[i], low, high);
    if (other.size() < fewest.size()) fewest = other;
  }
  for (Id i = fewest.begin; i < fewest.end; ++i) visit(fewest.vertex(s, i));
}

}  // namespace gale::detail
