#pragma once

#include <gale/mesh/simplices.hpp>
#include <gale/relations/relation.hpp>

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

/// Calls visit(triangle) for each triangle of a vertex, ascending.
template <class Memory, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_triangle_of_vertex(const Simplices<Memory>& s, Id vertex, const Visit& visit) {
  for (Id i = s.lower_begin(vertex); i < s.lower_begin(vertex + 1); ++i) {
    const Id edge = s.lower_edges(i);  // (low, vertex)
    const Id begin = s.triangle_begin(edge), end = s.triangle_begin(edge + 1);
    for (Id f = s.triangle_begin(s.edge_begin(s.edge_low(edge))); f < begin; ++f) {
      if (s.triangle_apex(f) == vertex) visit(f);
    }
    for (Id f = begin; f < end; ++f) visit(f);
  }
  const Id end = s.triangle_begin(s.edge_begin(vertex + 1));
  for (Id f = s.triangle_begin(s.edge_begin(vertex)); f < end; ++f) visit(f);
}

/// Calls visit(triangle) for each triangle of an edge, ascending.
template <class Memory, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_triangle_of_edge(const Simplices<Memory>& s, Id edge, const Visit& visit) {
  const Id a = s.edge_low(edge), b = s.edge_high(edge);
  const auto visit_over = [&](Id other) {
    const Id f = s.triangle_of(other, b);
    if (f != no_id) visit(f);
  };
  for (Id i = s.lower_begin(a); i < s.lower_begin(a + 1); ++i) visit_over(s.lower_edges(i));
  for (Id other = s.edge_begin(a); other < edge; ++other) visit_over(other);
  for (Id f = s.triangle_begin(edge); f < s.triangle_begin(edge + 1); ++f) visit(f);
}

/// Calls visit(t) for each tetrahedron (first, ., ., .), in order, of which `wanted` says so.
template <class Memory, class Wanted, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_tetrahedron_from(const Simplices<Memory>& s, Id first, const Wanted& wanted,
                                                      const Visit& visit) {
  for (Id t = s.tetrahedron_begin(first); t < s.tetrahedron_begin(first + 1); ++t) {
    if (wanted(s.tetrahedron(t))) visit(t);
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

/// Calls visit(tetrahedron) for each tetrahedron that has the vertices a < b, ascending.
template <class Memory, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_tetrahedron_of(const Simplices<Memory>& s, Id a, Id b, const Visit& visit) {
  const auto has_both = [a, b](const Quad& q) {
    return (q.a == a || q.b == a || q.c == a) && (q.b == b || q.c == b || q.d == b);
  };
  for_each_first_vertex(s, a, b, [&](Id first) { for_each_tetrahedron_from(s, first, has_both, visit); });
}

/// Calls visit(tetrahedron) for each tetrahedron that has the vertices a < b < c, ascending.
template <class Memory, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_tetrahedron_of(const Simplices<Memory>& s, Id a, Id b, Id c, const Visit& visit) {
  const auto has_all = [a, b, c](const Quad& q) {
    return (q.a == a || q.b == a) && (q.b == b || q.c == b) && (q.c == c || q.d == c);
  };
  for_each_first_vertex(s, a, b, [&](Id first) { for_each_tetrahedron_from(s, first, has_all, visit); });
}

}  // namespace gale::detail
