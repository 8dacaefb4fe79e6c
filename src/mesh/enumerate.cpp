#include <algorithm>

#include <gale/base/atomic.hpp>
#include <gale/mesh/distinct_rows.hpp>
#include <gale/mesh/enumerate.hpp>
#include <gale/mesh/many_triangles.hpp>
#include <gale/mesh/upper_link.hpp>

namespace gale::detail {

namespace {

using Ids = Array<Id, WorkerMemory>;
using Offsets = Array<Offset, WorkerMemory>;
using Tables = Simplices<WorkerMemory>;

/// The higher neighbours of a vertex.
struct HigherNeighbours {
  Tables simplices;
  Kokkos::View<const Offset*, WorkerMemory, Kokkos::MemoryUnmanaged> middle_begin;
  Kokkos::View<const Id*, WorkerMemory, Kokkos::MemoryUnmanaged> middle;

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
template <class Begin>
Id longest_row(const Begin& begin) {
  return -reduce_min(
      "GALE::longest_row", WorkerSpace(), Offset(begin.extent(0)) - 1, Id(0),
      KOKKOS_LAMBDA(Offset row) { return begin(row) - begin(row + 1); });
}

/// Does a thread know the triangles of a vertex by bits?
KOKKOS_FUNCTION bool has_upper_link(const Tables& simplices, Offset vertex) {
  return simplices.edge_begin(vertex + 1) - simplices.edge_begin(vertex) <= UpperLink::capacity;
}

/// Calls visit(link) with the upper link of a vertex.
template <class Visit>
KOKKOS_FUNCTION void with_upper_link(const Tables& simplices, const MiddleStars& stars, Offset vertex,
                                     const Visit& visit) {
  visit(UpperLink(simplices, static_cast<Id>(vertex), [&](const auto& visit_middle) {
    for (Offset i = stars.begin(vertex); i < stars.begin(vertex + 1); ++i) visit_middle(stars.tetrahedra(i));
  }));
}

/// count[e] = triangles of each edge (a, .) with higher vertices, if `a` has few edges; 0 otherwise. A thread a vertex.
void count_triangles(const Tables& simplices, const MiddleStars& stars, const Ids& count) {
  parallel_for(
      "GALE::count_triangles", WorkerSpace(), simplices.edge_begin.extent(0) - 1, KOKKOS_LAMBDA(Offset v) {
        if (!has_upper_link(simplices, v)) {
          for (Id edge = simplices.edge_begin(v); edge < simplices.edge_begin(v + 1); ++edge) count(edge) = 0;
          return;
        }
        with_upper_link(simplices, stars, v, [&](const UpperLink& link) {
          for (Id i = 0; i < link.size(); ++i) count(simplices.edge_begin(v) + i) = link.triangles(i);
        });
      });
}

/// Writes edges and apexes of those triangles. begin[e] is where those of edge e are.
void write_triangles(const Tables& simplices, const MiddleStars& stars, const Ids& begin, const Ids& edges,
                     const Ids& apexes) {
  parallel_for(
      "GALE::write_triangles", WorkerSpace(), simplices.edge_begin.extent(0) - 1, KOKKOS_LAMBDA(Offset v) {
        if (!has_upper_link(simplices, v)) return;
        with_upper_link(simplices, stars, v, [&](const UpperLink& link) {
          const Id first = simplices.edge_begin(v);
          Id at = begin(first);
          for (Id i = 0; i < link.size(); ++i) {
            link.for_each_apex(i, [&](Id c) {
              edges(at) = first + i;
              apexes(at++) = c;
            });
          }
        });
      });
}

}  // namespace

MiddleStars find_middle_stars(const Tables& simplices) {
  const WorkerSpace space;
  const Offset vertices = simplices.tetrahedron_begin.extent(0) - 1, tetrahedra = simplices.tetrahedra.extent(0);
  const Ids count("GALE::middle_count", vertices);
  parallel_for(
      "GALE::count_middle", space, tetrahedra, KOKKOS_LAMBDA(Offset t) {
        for (int corner = 1; corner < 3; ++corner) atomic_add(&count(simplices.tetrahedra(t, corner)), Id(1));
      });
  const MiddleStars stars{allocate<Offsets>("GALE::middle_begin", vertices + 1),
                          allocate<Ids>("GALE::middle_stars", 2 * tetrahedra)};
  exclusive_scan(
      "GALE::scan_middle", space, vertices, stars.begin, KOKKOS_LAMBDA(Offset v) { return count(v); });
  parallel_for(
      "GALE::fill_middle", space, tetrahedra, KOKKOS_LAMBDA(Offset t) {
        for (int corner = 1; corner < 3; ++corner) {
          const Id v = simplices.tetrahedra(t, corner);
          stars.tetrahedra(stars.begin(v) + atomic_add(&count(v), Id(-1)) - 1) = static_cast<Id>(t);
        }
      });
  return stars;
}

void enumerate_edges(const Tables& simplices, const MiddleStars& stars, SimplexTables<WorkerMemory>& tables) {
  const Offset vertices = simplices.tetrahedron_begin.extent(0) - 1;
  const auto edges = distinct_rows("edges", vertices, HigherNeighbours{simplices, stars.begin, stars.tetrahedra});
  tables.edge_begin = edges.begin;
  tables.edge_low = edges.row_of;
  tables.edge_high = edges.values;
}

void enumerate_triangles(const Tables& simplices, const MiddleStars& stars, SimplexTables<WorkerMemory>& tables) {
  const WorkerSpace space;
  const Offset edges = simplices.edge_low.extent(0);
  const Ids begin = allocate<Ids>("GALE::triangle_begin", edges + 1);
  count_triangles(simplices, stars, begin);
  const bool some_have_many = longest_row(simplices.edge_begin) > UpperLink::capacity;
  const ManyTriangles many = some_have_many ? ManyTriangles(simplices) : ManyTriangles();
  many.write_counts(begin);
  const Offset total = reduce_sum(
      "GALE::total_triangles", space, edges, KOKKOS_LAMBDA(Offset e) { return Offset(begin(e)); });
  require_ids("triangles", total);
  exclusive_scan(
      "GALE::scan_triangles", space, edges, begin, KOKKOS_LAMBDA(Offset e) { return begin(e); });
  const Ids edge_of = allocate<Ids>("GALE::triangle_edge", total), apex = allocate<Ids>("GALE::triangle_apex", total);
  write_triangles(simplices, stars, begin, edge_of, apex);
  many.write(begin, edge_of, apex);
  tables.triangle_begin = begin;
  tables.triangle_edge = edge_of;
  tables.triangle_apex = apex;
}

void sort_edges_by_higher(const Tables& simplices, SimplexTables<WorkerMemory>& tables) {
  const WorkerSpace space;
  const Offset vertices = simplices.edge_begin.extent(0) - 1, edges = simplices.edge_high.extent(0);
  const Ids count("GALE::lower_count", vertices);
  parallel_for(
      "GALE::count_lower", space, edges,
      KOKKOS_LAMBDA(Offset e) { atomic_add(&count(simplices.edge_high(e)), Id(1)); });
  const Ids begin = allocate<Ids>("GALE::lower_begin", vertices + 1), lower = allocate<Ids>("GALE::lower_edges", edges);
  exclusive_scan(
      "GALE::scan_lower", space, vertices, begin, KOKKOS_LAMBDA(Offset v) { return count(v); });
  parallel_for(
      "GALE::fill_lower", space, edges, KOKKOS_LAMBDA(Offset e) {
        const Id v = simplices.edge_high(e);
        lower(begin(v) + atomic_add(&count(v), Id(-1)) - 1) = static_cast<Id>(e);
      });
  sort_rows("GALE::sort_lower", begin, lower);
  tables.lower_begin = begin;
  tables.lower_edges = lower;
  tables.longest_list = longest_row(begin);
  for (const auto& others : {simplices.edge_begin, simplices.tetrahedron_begin}) {
    tables.longest_list = std::max(tables.longest_list, longest_row(others));
  }
}

}  // namespace gale::detail
