#include <algorithm>

#include <gale/base/group_by.hpp>
#include <gale/mesh/distinct_rows.hpp>
#include <gale/mesh/enumerate.hpp>
#include <gale/mesh/many_triangles.hpp>
#include <gale/mesh/upper_link.hpp>

namespace gale::detail {

namespace {

template <class Space>
using Ids = Array<Id, MemoryOf<Space>>;

/// The higher neighbours of a vertex.
template <class Memory>
struct HigherNeighbours {
  Simplices<Memory> simplices;
  Kokkos::View<const Offset*, Memory, Kokkos::MemoryUnmanaged> middle_begin;
  Kokkos::View<const Id*, Memory, Kokkos::MemoryUnmanaged> middle;

  template <class Visit>
  KOKKOS_FUNCTION void operator()(Id vertex, const Visit& visit) const {
    for (Id t = simplices.tetrahedron_begin(vertex); t < simplices.tetrahedron_begin(vertex + 1); ++t) {
      for (int corner = 1; corner < 4; ++corner) visit(simplices.tetrahedra(t, corner));
    }
    for (Offset i = middle_begin(vertex); i < middle_begin(vertex + 1); ++i) {
      const Id t = middle(i);
      if (simplices.tetrahedra(t, 1) == vertex) visit(simplices.tetrahedra(t, 2));
      visit(simplices.tetrahedra(t, 3));
    }
  }
};

/// Entries of the longest of the rows that begin[r] to begin[r + 1] - 1 are.
template <class Space, class Begin>
Id longest_row(const Space& space, const Begin& begin) {
  return -reduce_min(
      "GALE::longest_row", space, Offset(begin.extent(0)) - 1, Id(0),
      KOKKOS_LAMBDA(Offset row) { return begin(row) - begin(row + 1); });
}

/// Does a thread know the triangles of a vertex by bits?
template <class Memory>
KOKKOS_FUNCTION bool has_upper_link(const Simplices<Memory>& simplices, Offset vertex) {
  return simplices.edge_begin(vertex + 1) - simplices.edge_begin(vertex) <= UpperLink::capacity;
}

/// Calls visit(link) with the upper link of a vertex.
template <class Memory, class Visit>
KOKKOS_FUNCTION void with_upper_link(const Simplices<Memory>& simplices, const MiddleStars<Memory>& stars,
                                     Offset vertex, const Visit& visit) {
  visit(UpperLink(simplices, static_cast<Id>(vertex), [&](const auto& visit_middle) {
    for (Offset i = stars.begin(vertex); i < stars.begin(vertex + 1); ++i) visit_middle(stars.tetrahedra(i));
  }));
}

/// count[e] = triangles of each edge (a, .) with higher vertices, if `a` has few edges; 0 otherwise. A thread a vertex.
template <class Space>
void count_triangles(const Space& space, const Simplices<MemoryOf<Space>>& simplices,
                     const MiddleStars<MemoryOf<Space>>& stars, const Ids<Space>& count) {
  parallel_for(
      "GALE::count_triangles", space, simplices.edge_begin.extent(0) - 1, KOKKOS_LAMBDA(Offset v) {
        if (!has_upper_link(simplices, v)) {
          for (Id edge = simplices.edge_begin(v); edge < simplices.edge_begin(v + 1); ++edge) count(edge) = 0;
          return;
        }
        with_upper_link(simplices, stars, v, [&](const UpperLink& link) {
          for (Id i = 0; i < link.size(); ++i) count(simplices.edge_begin(v) + i) = link.triangles(i);
        });
      });
}

/// Writes the apexes of those triangles. begin[e] is where those of edge e are.
template <class Space>
void write_triangles(const Space& space, const Simplices<MemoryOf<Space>>& simplices,
                     const MiddleStars<MemoryOf<Space>>& stars, const Ids<Space>& begin, const Ids<Space>& apexes) {
  parallel_for(
      "GALE::write_triangles", space, simplices.edge_begin.extent(0) - 1, KOKKOS_LAMBDA(Offset v) {
        if (!has_upper_link(simplices, v)) return;
        with_upper_link(simplices, stars, v, [&](const UpperLink& link) {
          Id at = begin(simplices.edge_begin(v));
          for (Id i = 0; i < link.size(); ++i) link.for_each_apex(i, [&](Id c) { apexes(at++) = c; });
        });
      });
}

/// The second and third vertex of a tetrahedron.
template <class Memory>
struct MiddleVertices {
  Simplices<Memory> simplices;

  template <class Visit>
  KOKKOS_FUNCTION void operator()(Id t, const Visit& visit) const {
    for (int corner = 1; corner < 3; ++corner) visit(simplices.tetrahedra(t, corner));
  }
};

/// The higher vertex of an edge.
template <class Memory>
struct HigherVertex {
  Simplices<Memory> simplices;

  KOKKOS_FUNCTION Id operator()(Id edge) const { return simplices.edge_high(edge); }
};

}  // namespace

template <class Space>
MiddleStars<MemoryOf<Space>> find_middle_stars(const Space& space, const Simplices<MemoryOf<Space>>& simplices) {
  const Offset vertices = simplices.tetrahedron_begin.extent(0) - 1, tetrahedra = simplices.tetrahedra.extent(0);
  const auto stars =
      group_by("GALE::middle_stars", space, tetrahedra, vertices, MiddleVertices<MemoryOf<Space>>{simplices});
  return {stars.begin, stars.members};
}

template <class Space>
void enumerate_edges(const Space& space, const Simplices<MemoryOf<Space>>& simplices,
                     const MiddleStars<MemoryOf<Space>>& stars, SimplexTables& tables) {
  const Offset vertices = simplices.tetrahedron_begin.extent(0) - 1;
  const auto edges = distinct_rows(space, "edges", vertices,
                                   HigherNeighbours<MemoryOf<Space>>{simplices, stars.begin, stars.tetrahedra});
  tables.edge_begin = edges.begin;
  tables.edge_low = edges.row_of;
  tables.edge_high = edges.values;
}

template <class Space>
void enumerate_triangles(const Space& space, const Simplices<MemoryOf<Space>>& simplices,
                         const MiddleStars<MemoryOf<Space>>& stars, SimplexTables& tables) {
  const Offset edges = simplices.edge_low.extent(0);
  const auto begin = allocate<Ids<Space>>("GALE::triangle_begin", edges + 1);
  count_triangles(space, simplices, stars, begin);
  const bool some_have_many = longest_row(space, simplices.edge_begin) > UpperLink::capacity;
  const auto many = some_have_many ? ManyTriangles<Space>(space, simplices) : ManyTriangles<Space>();
  many.write_counts(begin);
  const Offset total = reduce_sum(
      "GALE::total_triangles", space, edges, KOKKOS_LAMBDA(Offset e) { return Offset(begin(e)); });
  require_ids("triangles", total);
  exclusive_scan(
      "GALE::scan_triangles", space, edges, begin, KOKKOS_LAMBDA(Offset e) { return begin(e); });
  const auto apex = allocate<Ids<Space>>("GALE::triangle_apex", total);
  write_triangles(space, simplices, stars, begin, apex);
  many.write(begin, apex);
  tables.triangle_begin = begin;
  tables.triangle_apex = apex;
}

template <class Space>
void find_triangle_edges(const Space& space, const Simplices<MemoryOf<Space>>& simplices, SimplexTables& tables) {
  const auto edge_of = allocate<Ids<Space>>("GALE::triangle_edge", simplices.triangle_apex.extent(0));
  parallel_for(
      "GALE::triangle_edge", space, simplices.triangle_begin.extent(0) - 1, KOKKOS_LAMBDA(Offset e) {
        for (Id f = simplices.triangle_begin(e); f < simplices.triangle_begin(e + 1); ++f)
          edge_of(f) = static_cast<Id>(e);
      });
  tables.triangle_edge = edge_of;
}

template <class Space>
void sort_edges_by_higher(const Space& space, const Simplices<MemoryOf<Space>>& simplices, SimplexTables& tables) {
  const Offset vertices = simplices.edge_begin.extent(0) - 1, edges = simplices.edge_high.extent(0);
  const auto lower =
      group_by_key<Id>("GALE::lower_edges", space, edges, vertices, HigherVertex<MemoryOf<Space>>{simplices});
  sort_rows(space, "GALE::sort_lower", lower.begin, lower.members);
  tables.lower_begin = lower.begin;
  tables.lower_edges = lower.members;
  tables.longest_list = std::max({longest_row(space, lower.begin), longest_row(space, simplices.edge_begin),
                                  longest_row(space, simplices.tetrahedron_begin)});
}

#define GALE_INSTANTIATE(Space)                                                                                       \
  template MiddleStars<MemoryOf<Space>> find_middle_stars(const Space&, const Simplices<MemoryOf<Space>>&);           \
  template void enumerate_edges(const Space&, const Simplices<MemoryOf<Space>>&, const MiddleStars<MemoryOf<Space>>&, \
                                SimplexTables&);                                                                      \
  template void enumerate_triangles(const Space&, const Simplices<MemoryOf<Space>>&,                                  \
                                    const MiddleStars<MemoryOf<Space>>&, SimplexTables&);                             \
  template void find_triangle_edges(const Space&, const Simplices<MemoryOf<Space>>&, SimplexTables&);                 \
  template void sort_edges_by_higher(const Space&, const Simplices<MemoryOf<Space>>&, SimplexTables&)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
