#pragma once

#include <gale/relations/faces.hpp>

// Which simplices a simplex is in, and which are beside it, from the tables alone: whatever segment they are in, by the
// host's threads and in kernels. The simplices that have a vertex v are among those that begin with v or with one of
// its lower neighbours, which are in the edges
// (., v); and simplices that begin alike are together. So each row is found by looking at a few short lists, mostly in
// its own order.

namespace gale::detail {

/// Calls visit(edge) for each edge at a vertex, ascending.
template <class Memory, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_edge_at(const Simplices<Memory>& s, Id vertex, const Visit& visit) {
  for (Id i = s.lower_begin(vertex); i < s.lower_begin(vertex + 1); ++i) visit(s.lower_edges(i));
  for (Id edge = s.edge_begin(vertex); edge < s.edge_begin(vertex + 1); ++edge) visit(edge);
}

/// Calls visit(t) for each tetrahedron (first, ., ., .), in order, of which `wanted` says so.
template <class Memory, class Wanted, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_tetrahedron_from(const Simplices<Memory>& s, Id first, const Wanted& wanted,
                                                      const Visit& visit) {
  const Id end = s.cell_begin(first + 1);
  for (Id t = s.cell_begin(first); t < end; ++t) {
    if (wanted(s.cell(t))) visit(t);
  }
}

/// Calls visit(first) for each lower neighbour of `a` that has an edge to b too, ascending, and then for a. a < b.
template <class Memory, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_first_vertex(const Simplices<Memory>& s, Id a, Id b, const Visit& visit) {
  for (Id i = s.lower_begin(a); i < s.lower_begin(a + 1); ++i) {
    const Id first = s.edge_low(s.lower_edges(i));
    if (s.edge_of(first, b) != no_id) visit(first);
  }
  visit(a);
}

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

/// Finds cofaces by looking through lists: best where all are short, as in almost every mesh.
struct LookThrough {
  /// Calls visit(triangle) for each triangle (low, v, high) with v between these, ascending; those over (low, high)
  /// begin at `end`.
  template <class Memory, class Visit>
  KOKKOS_INLINE_FUNCTION static void for_each_triangle_under(const Simplices<Memory>& s, Id low, Id high, Id end,
                                                             const Visit& visit) {
    for (Id f = s.triangle_begin(s.edge_begin(low)); f < end; ++f) {
      if (s.triangle_apex(f) == high) visit(f);
    }
  }

  /// Calls visit(triangle) for each triangle of an edge, ascending.
  template <class Memory, class Visit>
  KOKKOS_INLINE_FUNCTION static void for_each_triangle_of_edge(const Simplices<Memory>& s, Id edge,
                                                               const Visit& visit) {
    const Id a = s.edge_low(edge), b = s.edge_high(edge);
    const auto visit_over = [&](Id other) {
      const Id f = s.triangle_of(other, b);
      if (f != no_id) visit(f);
    };
    for (Id i = s.lower_begin(a); i < s.lower_begin(a + 1); ++i) visit_over(s.lower_edges(i));
    for (Id other = s.edge_begin(a); other < edge; ++other) visit_over(other);
    for (Id f = s.triangle_begin(edge); f < s.triangle_begin(edge + 1); ++f) visit(f);
  }

  /// Calls visit(tetrahedron) for each tetrahedron that has the vertices a < b, ascending.
  template <class Memory, class Visit>
  KOKKOS_INLINE_FUNCTION static void for_each_tetrahedron_of(const Simplices<Memory>& s, Id a, Id b,
                                                             const Visit& visit) {
    const auto has_both = [a, b](const Quad& q) {
      return (q.a == a || q.b == a || q.c == a) && (q.b == b || q.c == b || q.d == b);
    };
    for_each_first_vertex(s, a, b, [&](Id first) { for_each_tetrahedron_from(s, first, has_both, visit); });
  }

  /// Calls visit(tetrahedron) for each tetrahedron that has the vertices a < b < c, ascending.
  template <class Memory, class Visit>
  KOKKOS_INLINE_FUNCTION static void for_each_tetrahedron_of(const Simplices<Memory>& s, Id a, Id b, Id c,
                                                             const Visit& visit) {
    const auto has_all = [a, b, c](const Quad& q) {
      return (q.a == a || q.b == a) && (q.b == b || q.c == b) && (q.c == c || q.d == c);
    };
    for_each_first_vertex(s, a, b, [&](Id first) { for_each_tetrahedron_from(s, first, has_all, visit); });
  }

  /// Calls visit(t) for each tetrahedron that shares a triangle with `tetrahedron` (a, b, c, d): ascending those that
  /// share one with a, and then those that share (b, c, d).
  template <class Memory, class Visit>
  KOKKOS_INLINE_FUNCTION static void for_each_adjacent_tetrahedron(const Simplices<Memory>& s, Id tetrahedron,
                                                                   const Visit& visit) {
    const Quad own = s.cell(tetrahedron);
    const Id a = own.a;
    const auto shares_one_with_a = [own](const Quad& q) {
      const int common = (q.b == own.b || q.c == own.b || q.d == own.b) +
                         (q.b == own.c || q.c == own.c || q.d == own.c) +
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
};

/// Calls visit(triangle) for each triangle of a vertex, ascending.
template <class Search, class Memory, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_triangle_of_vertex(const Simplices<Memory>& s, Id vertex, const Visit& visit) {
  for (Id i = s.lower_begin(vertex); i < s.lower_begin(vertex + 1); ++i) {
    const Id edge = s.lower_edges(i);  // (low, vertex)
    const Id begin = s.triangle_begin(edge), end = s.triangle_begin(edge + 1);
    Search::for_each_triangle_under(s, s.edge_low(edge), vertex, begin, visit);
    for (Id f = begin; f < end; ++f) visit(f);
  }
  const Id end = s.triangle_begin(s.edge_begin(vertex + 1));
  for (Id f = s.triangle_begin(s.edge_begin(vertex)); f < end; ++f) visit(f);
}

/// Calls visit(triangle) for each triangle that shares an edge with `triangle`: edge by edge, each time ascending. Two
/// distinct triangles share no more than one.
template <class Search, class Memory, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_adjacent_triangle(const Simplices<Memory>& s, Id triangle, const Visit& visit) {
  for (const Id edge : face_row<Relation::FE>(s, triangle)) {
    Search::for_each_triangle_of_edge(s, edge, [&](Id other) {
      if (other != triangle) visit(other);
    });
  }
}

}  // namespace gale::detail
