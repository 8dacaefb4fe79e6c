#include <algorithm>

#include <gale/base/error.hpp>
#include <gale/base/group_by.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort.hpp>
#include <gale/mesh/numbering/candidates.hpp>
#include <gale/mesh/numbering/enumerate.hpp>
#include <gale/mesh/numbering/sorted_pairs.hpp>

namespace gale::detail {

namespace {

/// The vertices of a cell between its lowest and its highest.
template <class Memory>
struct MiddleVertices {
  Simplices<Memory> simplices;

  GALE_CALLS_ANY
  template <class Visit>
  KOKKOS_FUNCTION void operator()(Id t, const Visit& visit) const {
    for (int corner = 1; corner < simplices.dimension; ++corner) visit(simplices.cells(t, corner));
  }
};

/// The higher neighbours of a vertex, once for each of its cells.
template <class Memory>
struct HigherNeighbours {
  Simplices<Memory> simplices;
  MiddleStars<Memory> stars;

  template <class Visit>
  KOKKOS_FUNCTION void operator()(Id vertex, const Visit& visit) const {
    for (Id t = simplices.cell_begin(vertex); t < simplices.cell_begin(vertex + 1); ++t) {
      for (int corner = 1; corner <= simplices.dimension; ++corner) visit(simplices.cells(t, corner));
    }
    for (const Id t : stars.row(vertex)) {
      if (simplices.cells(t, 1) == vertex) visit(simplices.cells(t, 2));
      visit(simplices.cells(t, 3));
    }
  }
};

/// The edges of a cell whose lower vertex has too many for a lane.
template <class Memory>
struct EdgesOfMany {
  Simplices<Memory> simplices;
  Borrowed<Id, Memory> count;

  template <class Visit>
  KOKKOS_FUNCTION void operator()(Id t, const Visit& visit) const {
    for (int low = 0; low < simplices.dimension; ++low) {
      const Id vertex = simplices.cells(t, low);
      if (count(vertex) != FewDistinct::too_many) continue;
      for (int high = low + 1; high <= simplices.dimension; ++high) visit(pair_key(vertex, simplices.cells(t, high)));
    }
  }
};

}  // namespace

template <class Space>
MiddleStars<MemoryOf<Space>> find_middle_stars(const Space& space, const Simplices<MemoryOf<Space>>& simplices) {
  const Offset vertices = simplices.cell_begin.extent(0) - 1, cells = simplices.cells.extent(0);
  return group_by("GALE::middle_stars", space, cells, vertices, MiddleVertices<MemoryOf<Space>>{simplices});
}

template <class Space>
void enumerate_edges(const Space& space, const Simplices<MemoryOf<Space>>& simplices,
                     const MiddleStars<MemoryOf<Space>>& stars, SimplexTables& tables) {
  using Memory = MemoryOf<Space>;
  const Offset vertices = simplices.cell_begin.extent(0) - 1;
  const HigherNeighbours<Memory> candidates{simplices, stars};
  const auto count = allocate<Array<Id, Memory>>("GALE::edge_begin", vertices + 1);
  parallel_for(
      "GALE::count_edges", space, vertices, KOKKOS_LAMBDA(Offset v) {
        FewDistinct few;
        candidates(static_cast<Id>(v), [&](Id id) { few.insert(id); });
        count(v) = few.size();
      });
  const bool some_have_many =
      reduce_min("GALE::find_many_edges", space, vertices, Id(0), count) == FewDistinct::too_many;
  const auto many = some_have_many
                        ? SortedPairs<Space>(space, simplices.cells.extent(0), EdgesOfMany<Memory>{simplices, count})
                        : SortedPairs<Space>();
  many.write_counts(count);
  const auto ends = rows_with(space, "edges", count);
  parallel_for(
      "GALE::write_edges", space, vertices, KOKKOS_LAMBDA(Offset v) {
        FewDistinct few;
        candidates(static_cast<Id>(v), [&](Id id) { few.insert(id); });
        for (Id i = 0; i < few.size(); ++i) ends.entries(ends.offsets(v) + i) = few[i];
      });
  many.write(ends.offsets, ends.entries);
  const auto low = row_of_entries(space, "GALE::edge_low", ends.offsets, ends.entries.extent(0));
  tables.edge_begin = ends.offsets;
  tables.edge_low = low;
  tables.edge_high = ends.entries;
}

template <class Space>
void sort_edges_by_higher(const Space& space, const Simplices<MemoryOf<Space>>& simplices, SimplexTables& tables) {
  const Offset vertices = simplices.edge_begin.extent(0) - 1, edges = simplices.edge_high.extent(0);
  const auto lower = group_by_key<Id>("GALE::lower_edges", space, edges, vertices, simplices.edge_high);
  sort_rows(space, "GALE::sort_lower", lower);
  tables.lower_begin = lower.offsets;
  tables.lower_edges = lower.entries;
  tables.longest_list = std::max({longest_row(space, lower.offsets), longest_row(space, simplices.edge_begin),
                                  longest_row(space, simplices.cell_begin)});
}

template <class Space>
Csr<Id, MemoryOf<Space>, Id> rows_with(const Space& space, const std::string& name,
                                       const Array<Id, MemoryOf<Space>>& count) {
  const Offset rows = static_cast<Offset>(count.extent(0)) - 1;
  const Offset total = reduce_sum(("GALE::total_" + name).c_str(), space, rows, count);
  require_ids(name.c_str(), total);
  exclusive_scan(("GALE::scan_" + name).c_str(), space, rows, count, count);
  return {count, allocate<Array<Id, MemoryOf<Space>>>("GALE::" + name, total)};
}

template <class Space>
Array<Id, MemoryOf<Space>> row_of_entries(const Space& space, const char* label,
                                          const Borrowed<Id, MemoryOf<Space>>& begin, Offset entries) {
  const auto row_of = allocate<Array<Id, MemoryOf<Space>>>(label, entries);
  parallel_for(
      label, space, Offset(begin.extent(0)) - 1, KOKKOS_LAMBDA(Offset row) {
        for (Id i = begin(row); i < begin(row + 1); ++i) row_of(i) = static_cast<Id>(row);
      });
  return row_of;
}

template <class Space>
Id longest_row(const Space& space, const Borrowed<Id, MemoryOf<Space>>& begin) {
  return -reduce_min(
      "GALE::longest_row", space, Offset(begin.extent(0)) - 1, Id(0),
      KOKKOS_LAMBDA(Offset row) { return begin(row) - begin(row + 1); });
}

#define GALE_INSTANTIATE(Space)                                                                                       \
  template MiddleStars<MemoryOf<Space>> find_middle_stars(const Space&, const Simplices<MemoryOf<Space>>&);           \
  template void enumerate_edges(const Space&, const Simplices<MemoryOf<Space>>&, const MiddleStars<MemoryOf<Space>>&, \
                                SimplexTables&);                                                                      \
  template void sort_edges_by_higher(const Space&, const Simplices<MemoryOf<Space>>&, SimplexTables&);                \
  template Csr<Id, MemoryOf<Space>, Id> rows_with(const Space&, const std::string&,                                   \
                                                  const Array<Id, MemoryOf<Space>>&);                                 \
  template Array<Id, MemoryOf<Space>> row_of_entries(const Space&, const char*, const Borrowed<Id, MemoryOf<Space>>&, \
                                                     Offset);                                                         \
  template Id longest_row(const Space&, const Borrowed<Id, MemoryOf<Space>>&)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
