#include <gale/base/group_by.hpp>
#include <gale/base/ordered.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/rank_rows.hpp>
#include <gale/base/sort.hpp>
#include <gale/mesh/encode/cells.hpp>

namespace gale::detail {

namespace {

/// Visits the lowest vertex of a cell if all are there.
template <int corners, class Index>
struct LowestVertex {
  Renumbered<corners, Index> input;

  GALE_CALLS_ANY
  template <class Visit>
  KOKKOS_FUNCTION void operator()(Id t, const Visit& visit) const {
    const Id lowest = input.lowest(t);
    if (lowest != no_id) visit(lowest);
  }
};

/// A cell in GALE's ids, and where it stood in the input.
struct Entry {
  Quad vertices;
  Id input;

  KOKKOS_FUNCTION bool operator<(const Entry& other) const {
    return vertices == other.vertices ? input < other.input : vertices < other.vertices;
  }
};

/// The cells that are sorted, as RankRows reads and writes them.
struct CellEntries {
  Quad* vertices;
  Id* input;

  KOKKOS_FUNCTION Entry load(Offset t) const { return {vertices[t], input[t]}; }
  KOKKOS_FUNCTION void store(Offset t, const Entry& entry) const {
    vertices[t] = entry.vertices;
    input[t] = entry.input;
  }
};

}  // namespace

template <int corners, class Space, class Index>
SortedCells<MemoryOf<Space>> sort_cells_by_vertices(const Space& space,
                                                    const CellCorners<corners, Index, MemoryOf<Space>>& given,
                                                    const Array<Id, MemoryOf<Space>>& vertex_internal) {
  using Memory = MemoryOf<Space>;
  const Offset vertices = vertex_internal.extent(0), count = given.extent(0);
  const Renumbered<corners, Index> input(given, vertex_internal);
  const auto counted = count_groups<Id>("GALE::cells", space, count, vertices, LowestVertex<corners, Index>{input});
  if (counted.members < count) refuse_cells<corners, Space, Index>(space, given, {}, vertices);
  const SortedCells<Memory> sorted{{counted.begin, allocate<Array<Quad, Memory>>("GALE::sorted_cells", count)},
                                   allocate<Array<Id, Memory>>("GALE::cell_input", count)};
  const CellEntries cells{sorted.of_lowest.entries.data(), sorted.input.data()};
  const auto next = counted.next;
  parallel_for(
      "GALE::cells_fill", space, count, KOKKOS_LAMBDA(Offset t) {
        const Quad quad = input[t];
        cells.store(atomic_add(&next(quad.a), Id(1)), {quad, static_cast<Id>(t)});
      });
  // Some six cells a vertex: twice as many as come to that have room together.
  constexpr int vertices_of_team = 16, cells_of_team = 256;
  const auto begin = counted.begin;
  rank_rows("GALE::sort_cells", space,
            RankRows<Id, CellEntries>{cells, begin.data(), vertices, vertices_of_team, cells_of_team});
  const int good = reduce_min(
      "GALE::check_cells", space, vertices, 1,
      KOKKOS_LAMBDA(Offset v) { return are_good<corners>(cells.vertices, begin(v), begin(v + 1)) ? 1 : 0; });
  if (good == 0) refuse_cells<corners, Space, Index>(space, given, sorted, vertices);
  return sorted;
}

template <class Space>
Array<Id, MemoryOf<Space>> segments_of_blocks(const Space& space, const Borrowed<Id, MemoryOf<Space>>& vertex_begin,
                                              Offset vertices) {
  constexpr int bits = SegmentOfVertex::block_bits;
  const auto blocks = allocate<Array<Id, MemoryOf<Space>>>("GALE::segment_of", (vertices >> bits) + 1);
  const auto segments = static_cast<Id>(vertex_begin.extent(0)) - 1;
  parallel_for(
      "GALE::segment_of", space, blocks.extent(0), KOKKOS_LAMBDA(Offset block) {
        blocks(block) = bisect(Id(0), segments, [&](Id segment) { return vertex_begin(segment + 1) <= block << bits; });
      });
  return blocks;
}

template <class Space>
Csr<Id, MemoryOf<Space>> find_external_cells(const Space& space, const Csr<Quad, MemoryOf<Space>, Id>& cells_of_lowest,
                                             const Borrowed<Id, MemoryOf<Space>>& vertex_begin) {
  const auto& cells = cells_of_lowest.entries;
  const auto blocks = segments_of_blocks(space, vertex_begin, cells_of_lowest.rows());
  const auto external = group_by("GALE::external", space, cells.extent(0), vertex_begin.extent(0) - 1,
                                 ExternalSegments{cells.data(), {blocks.data(), vertex_begin.data()}});
  sort_rows(space, "GALE::sort_external", external);
  return external;
}

#define GALE_INSTANTIATE_INDEX(Space, corners, Index)                    \
  template SortedCells<MemoryOf<Space>> sort_cells_by_vertices<corners>( \
      const Space&, const CellCorners<corners, Index, MemoryOf<Space>>&, const Array<Id, MemoryOf<Space>>&)
#define GALE_INSTANTIATE(Space)                                                                                       \
  template Array<Id, MemoryOf<Space>> segments_of_blocks(const Space&, const Borrowed<Id, MemoryOf<Space>>&, Offset); \
  GALE_INSTANTIATE_INDEX(Space, 4, std::int32_t);                                                                     \
  GALE_INSTANTIATE_INDEX(Space, 4, std::int64_t);                                                                     \
  GALE_INSTANTIATE_INDEX(Space, 3, std::int32_t);                                                                     \
  GALE_INSTANTIATE_INDEX(Space, 3, std::int64_t);                                                                     \
  template Csr<Id, MemoryOf<Space>> find_external_cells(const Space&, const Csr<Quad, MemoryOf<Space>, Id>&,          \
                                                        const Borrowed<Id, MemoryOf<Space>>&)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE
#undef GALE_INSTANTIATE_INDEX

}  // namespace gale::detail
