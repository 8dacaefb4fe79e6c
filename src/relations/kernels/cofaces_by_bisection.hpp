#pragma once

#include <gale/base/ordered.hpp>
#include <gale/relations/faces.hpp>
#include <gale/relations/kernels/cofaces.hpp>

// What cofaces.hpp finds, where some lists are long: nothing is looked through that may be. Simplices
// around a simplex differ from it by vertices that are neighbours of all of its own. So those of that vertex are tried
// that has the fewest neighbours, and each simplex is looked for where it would stand. Around an edge (a, b) this takes
// the lesser degree of its ends, times a logarithm.

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

/// Calls visit(triangle) for the triangle (a, b, c), if there is one.
template <class Memory, class Visit>
KOKKOS_INLINE_FUNCTION void visit_triangle(const Simplices<Memory>& s, Id a, Id b, Id c, const Visit& visit) {
  const Id f = s.triangle_of(a, b, c);
  if (f != no_id) visit(f);
}

/// The first tetrahedron (a, ., ., .), from `begin` on and before `end`, that is not before (a, b, c, d).
template <class Memory>
KOKKOS_INLINE_FUNCTION Id first_tetrahedron(const Simplices<Memory>& s, Id begin, Id end, Id b, Id c, Id d) {
  return bisect(begin, end, [&](Id t) {
    const Quad q = s.cell(t);
    return q.b < b || (q.b == b && (q.c < c || (q.c == c && q.d < d)));
  });
}

/// Calls visit(t) for the tetrahedron (a, b, c, d), if there is one.
template <class Memory, class Visit>
KOKKOS_INLINE_FUNCTION void visit_tetrahedron(const Simplices<Memory>& s, Id a, Id b, Id c, Id d, const Visit& visit) {
  const Id end = s.cell_begin(a + 1);
  const Id t = first_tetrahedron(s, s.cell_begin(a), end, b, c, d);
  if (t == end) return;
  const Quad q = s.cell(t);
  if (q.b == b && q.c == c && q.d == d) visit(t);
}

/// Calls visit(t) for each tetrahedron (a, b, c, .), ascending.
template <class Memory, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_tetrahedron_over(const Simplices<Memory>& s, Id a, Id b, Id c,
                                                      const Visit& visit) {
  const Id end = s.cell_begin(a + 1);
  for (Id t = first_tetrahedron(s, s.cell_begin(a), end, b, c, 0); t < end; ++t) {
    const Quad q = s.cell(t);
    if (q.b != b || q.c != c) return;
    visit(t);
  }
}

/// Calls visit(t) for each tetrahedron (a, v, ., .) that has the vertices a < v < b, ascending.
template <class Memory, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_tetrahedron_over_edge(const Simplices<Memory>& s, Id a, Id v, Id b,
                                                           const Visit& visit) {
  const Id end = s.cell_begin(a + 1);
  const Id begin = first_tetrahedron(s, s.cell_begin(a), end, v, 0, 0);
  if (end - begin <= few_entries || s.cell(begin + few_entries).b != v) {
    for (Id t = begin; t < end; ++t) {
      const Quad q = s.cell(t);
      if (q.b != v) return;
      if (q.c == b || q.d == b) visit(t);
    }
    return;
  }
  const Id known[] = {a, v, b};
  for_each_candidate(s, known, v, b, [&](Id w) { visit_tetrahedron(s, a, v, w, b, visit); });
  for_each_tetrahedron_over(s, a, v, b, visit);
}

/// Calls visit(t) for each tetrahedron (a, ., ., .) that has the vertices a < b < c, ascending.
template <class Memory, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_tetrahedron_from(const Simplices<Memory>& s, Id a, Id b, Id c,
                                                      const Visit& visit) {
  const Id begin = s.cell_begin(a), end = s.cell_begin(a + 1);
  if (end - begin <= few_entries) {
    const auto has = [b, c](const Quad& q) { return (q.b == b || q.c == b) && (q.c == c || q.d == c); };
    return for_each_tetrahedron_from(s, a, has, visit);
  }
  const Id known[] = {a, b, c};
  for_each_candidate(s, known, a, b, [&](Id v) { visit_tetrahedron(s, a, v, b, c, visit); });
  for_each_tetrahedron_over_edge(s, a, b, c, visit);
}

/// Calls visit(t) for each tetrahedron (a, ., ., .) that has the vertices a < b, ascending.
template <class Memory, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_tetrahedron_from(const Simplices<Memory>& s, Id a, Id b, const Visit& visit) {
  const Id begin = s.cell_begin(a), end = s.cell_begin(a + 1);
  if (end - begin <= few_entries) {
    return for_each_tetrahedron_from(
        s, a, [b](const Quad& q) { return q.b == b || q.c == b || q.d == b; }, visit);
  }
  const Id known[] = {a, b};
  for_each_candidate(s, known, a, b, [&](Id v) { for_each_tetrahedron_over_edge(s, a, v, b, visit); });
  for (Id t = first_tetrahedron(s, begin, end, b, 0, 0); t < end && s.cell(t).b == b; ++t) visit(t);
}

/// Finds cofaces by bisection, in what time the shortest of the lists takes.
struct Bisect {
  /// Calls visit(triangle) for each triangle (low, v, high) with v between these, ascending; those over (low, high)
  /// begin at `end`.
  template <class Memory, class Visit>
  KOKKOS_INLINE_FUNCTION static void for_each_triangle_under(const Simplices<Memory>& s, Id low, Id high, Id end,
                                                             const Visit& visit) {
    if (end - s.triangle_begin(s.edge_begin(low)) <= few_entries)
      return LookThrough::for_each_triangle_under(s, low, high, end, visit);
    const Id known[] = {low, high};
    for_each_candidate(s, known, low, high, [&](Id v) { visit_triangle(s, low, v, high, visit); });
  }

  /// Calls visit(triangle) for each triangle of an edge, ascending.
  template <class Memory, class Visit>
  KOKKOS_INLINE_FUNCTION static void for_each_triangle_of_edge(const Simplices<Memory>& s, Id edge,
                                                               const Visit& visit) {
    const Id a = s.edge_low(edge), b = s.edge_high(edge);
    const Id known[] = {a, b};
    for_each_candidate(s, known, no_id, a, [&](Id v) { visit_triangle(s, v, a, b, visit); });
    for_each_candidate(s, known, a, b, [&](Id v) { visit_triangle(s, a, v, b, visit); });
    for (Id f = s.triangle_begin(edge); f < s.triangle_begin(edge + 1); ++f) visit(f);
  }

  /// Calls visit(tetrahedron) for each tetrahedron that has the vertices a < b, ascending.
  template <class Memory, class Visit>
  KOKKOS_INLINE_FUNCTION static void for_each_tetrahedron_of(const Simplices<Memory>& s, Id a, Id b,
                                                             const Visit& visit) {
    const Id known[] = {a, b};
    for_each_candidate(s, known, no_id, a, [&](Id v) {
      if (s.edge_of(v, a) != no_id && s.edge_of(v, b) != no_id) for_each_tetrahedron_from(s, v, a, b, visit);
    });
    for_each_tetrahedron_from(s, a, b, visit);
  }

  /// Calls visit(tetrahedron) for each tetrahedron that has the vertices a < b < c, ascending.
  template <class Memory, class Visit>
  KOKKOS_INLINE_FUNCTION static void for_each_tetrahedron_of(const Simplices<Memory>& s, Id a, Id b, Id c,
                                                             const Visit& visit) {
    const Id known[] = {a, b, c};
    for_each_candidate(s, known, no_id, a, [&](Id v) { visit_tetrahedron(s, v, a, b, c, visit); });
    for_each_tetrahedron_from(s, a, b, c, visit);
  }

  /// Calls visit(t) for each tetrahedron that shares a triangle with `tetrahedron`: triangle by triangle, each time
  /// ascending.
  template <class Memory, class Visit>
  KOKKOS_INLINE_FUNCTION static void for_each_adjacent_tetrahedron(const Simplices<Memory>& s, Id tetrahedron,
                                                                   const Visit& visit) {
    const FaceRow<4> own = face_row<Relation::TV>(s, tetrahedron);
    for (int across = 0; across < 4; ++across) {
      for_each_tetrahedron_of(s, own[across < 1 ? 1 : 0], own[across < 2 ? 2 : 1], own[across < 3 ? 3 : 2],
                              [&](Id other) {
                                if (other != tetrahedron) visit(other);
                              });
    }
  }
};

}  // namespace gale::detail
