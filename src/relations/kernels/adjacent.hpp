#pragma once

#include <gale/relations/kernels/cofaces.hpp>

namespace gale::detail {

/// The edges at a vertex by their places, ascending.
template <class Memory>
struct EdgesAt {
  const Simplices<Memory>& simplices;
  Id lower_begin, lower, first_own, count;

  KOKKOS_INLINE_FUNCTION EdgesAt(const Simplices<Memory>& s, Id vertex)
      : simplices(s),
        lower_begin(s.lower_begin(vertex)),
        lower(s.lower_begin(vertex + 1) - lower_begin),
        first_own(s.edge_begin(vertex)),
        count(lower + s.edge_begin(vertex + 1) - first_own) {}

  KOKKOS_INLINE_FUNCTION Id operator[](Id i) const {
    return i < lower ? simplices.lower_edges(lower_begin + i) : first_own + (i - lower);
  }
};

/// Calls visit(edge) for each edge that shares one vertex with `edge`, ascending: those at its two ends, merged. Only
/// `edge` is at both.
template <class Memory, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_adjacent_edge(const Simplices<Memory>& s, Id edge, const Visit& visit) {
  const EdgesAt<Memory> low(s, s.edge_low(edge)), high(s, s.edge_high(edge));
  Id i = 0, j = 0;
  Id at_low = low[0], at_high = high[0];
  for (Id left = low.count + high.count; left > 0; --left) {
    const bool take_low = j == high.count || (i < low.count && at_low < at_high);
    const Id next = take_low ? at_low : at_high;
    if (next != edge) visit(next);
    if (take_low) {
      if (++i < low.count) at_low = low[i];
    } else {
      if (++j < high.count) at_high = high[j];
    }
  }
}

/// Calls visit(triangle) for each triangle that shares an edge with `triangle`: edge by edge, each time ascending. Two
/// distinct triangles share no more than one.
template <class Memory, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_adjacent_triangle(const Simplices<Memory>& s, Id triangle, const Visit& visit) {
  const Id ab = s.triangle_edge(triangle), c = s.triangle_apex(triangle);
  const Id edges[3] = {ab, s.edge_of(s.edge_low(ab), c), s.edge_of(s.edge_high(ab), c)};
  for (int i = 0; i < 3; ++i) {
    for_each_triangle_of_edge(s, edges[i], [&](Id other) {
      if (other != triangle) visit(other);
    });
  }
}

/// Calls visit(t) for each tetrahedron that shares a triangle with `tetrahedron` (a, b, c, d): ascending those that
/// share one with a, and then those that share (b, c, d).
template <class Memory, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_adjacent_tetrahedron(const Simplices<Memory>& s, Id tetrahedron,
                                                          const Visit& visit) {
  const Quad own = s.tetrahedron(tetrahedron);
  const Id a = own.a;
  const auto shares_one_with_a = [own](const Quad& q) {
    const int common = (q.b == own.b || q.c == own.b || q.d == own.b) + (q.b == own.c || q.c == own.c || q.d == own.c) +
                       (q.b == own.d || q.c == own.d || q.d == own.d);
    return common == 2 && (q.a == own.a || q.b == own.a);
  };
  const auto visit_from = [&](Id first) { for_each_tetrahedron_from(s, first, shares_one_with_a, visit); };
  for (Id i = s.lower_begin(a); i < s.lower_begin(a + 1); ++i) {
    const Id first = s.edge_low(s.lower_edges(i));
    if (s.edge_of(first, own.b) != no_id || s.edge_of(first, own.c) != no_id) visit_from(first);
  }
  visit_from(a);
  for_each_tetrahedron_of(s, own.b, own.c, own.d, [&](Id other) {
    if (other != tetrahedron) visit(other);
  });
}

}  // namespace gale::detail
