#include <gale/base/atomic.hpp>
#include <gale/base/group_by.hpp>
#include <gale/base/ordered.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>
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

/// A team's work: puts the cells of each of some consecutive lowest vertices in order, and says whether they are good.
/// Puts each where as many of its vertex's stand as come before it. Those of a vertex that has more than there is room
/// for are sorted by one thread.
template <int corners>
struct SortCells {
  static constexpr int scratch_level = 0, vertices_of_team = 64, room = 768;  ///< some six cells a vertex

  /// What a team keeps of them.
  struct Cells {
    Quad vertices[room];
    Id input[room];
  };

  Quad* vertices;
  Id* input;
  const Id* begin;  ///< of each vertex's cells
  Offset count;     ///< of vertices
  int* bad;         ///< is given 1 if some aren't good

  KOKKOS_FUNCTION std::size_t scratch_bytes() const { return sizeof(Cells); }

  template <class Team>
  KOKKOS_FUNCTION void operator()(const Team& team) const {
    Cells& cells = *reinterpret_cast<Cells*>(team::scratch<scratch_level>(team, scratch_bytes()));
    const Offset first = static_cast<Offset>(team.league_rank()) * vertices_of_team,
                 last = first + vertices_of_team < count ? first + vertices_of_team : count;
    if (begin[last] - begin[first] <= room) return sort(team, cells, first, last);
    for (Offset vertex = first; vertex < last; ++vertex) {
      if (begin[vertex + 1] - begin[vertex] <= room) {
        team::barrier(team);  // for what others still read of the vertex before
        sort(team, cells, vertex, vertex + 1);
      } else {
        team::once(team, [&] { sort_by_thread(begin[vertex], begin[vertex + 1]); });
      }
    }
  }

 private:
  template <class Team>
  KOKKOS_FUNCTION void sort(const Team& team, Cells& cells, Offset first, Offset last) const {
    const Id from = begin[first];
    const int here = begin[last] - from;
    team::for_all(team, here, [&](int i) {
      cells.vertices[i] = vertices[from + i];
      cells.input[i] = input[from + i];
    });
    team::barrier(team);
    team::for_all(team, here, [&](int i) {
      const Quad cell = cells.vertices[i];
      const Id number = cells.input[i];
      const int end = begin[cell.a + 1] - from;
      int place = begin[cell.a] - from;
      bool good = has_different_vertices<corners>(cell);
      for (int k = place; k < end; ++k) {
        const Quad other = cells.vertices[k];
        const bool is_twin = k != i && other == cell;
        good &= !is_twin;
        place += other < cell || (is_twin && cells.input[k] < number) ? 1 : 0;
      }
      vertices[from + place] = cell;
      input[from + place] = number;
      if (!good) atomic_max(bad, 1);
    });
  }

  /// A cell and where it stood.
  struct Entry {
    Quad vertices;
    Id input;

    KOKKOS_FUNCTION bool operator<(const Entry& other) const {
      return vertices == other.vertices ? input < other.input : vertices < other.vertices;
    }
  };

  KOKKOS_FUNCTION void sort_by_thread(Id first, Id last) const {
    heap_sort(
        last - first,
        [&](Id i) {
          return Entry{vertices[first + i], input[first + i]};
        },
        [&](Id i, const Entry& entry) {
          vertices[first + i] = entry.vertices;
          input[first + i] = entry.input;
        });
    if (!are_good<corners>(vertices, first, last)) atomic_max(bad, 1);
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
  Quad* const quads = sorted.of_lowest.entries.data();
  Id* const from = sorted.input.data();
  const auto next = counted.next;
  parallel_for(
      "GALE::cells_fill", space, count, KOKKOS_LAMBDA(Offset t) {
        const Quad quad = input[t];
        const Id to = atomic_add(&next(quad.a), Id(1));
        quads[to] = quad;
        from[to] = static_cast<Id>(t);
      });
  const auto bad = allocate<Array<int, Memory>>("GALE::bad_cells", 1);
  fill("GALE::bad_cells", space, bad, 0);
  using Sort = SortCells<corners>;
  constexpr int warps = 8;
  for_teams("GALE::sort_cells", space, (vertices + Sort::vertices_of_team - 1) / Sort::vertices_of_team, warps, count,
            Sort{quads, from, counted.begin.data(), vertices, bad.data()});
  if (on_host(bad)(0) != 0) refuse_cells<corners, Space, Index>(space, given, sorted, vertices);
  return sorted;
}

#define GALE_INSTANTIATE_INDEX(Space, corners, Index)                    \
  template SortedCells<MemoryOf<Space>> sort_cells_by_vertices<corners>( \
      const Space&, const CellCorners<corners, Index, MemoryOf<Space>>&, const Array<Id, MemoryOf<Space>>&)
#define GALE_INSTANTIATE(Space)                   \
  GALE_INSTANTIATE_INDEX(Space, 4, std::int32_t); \
  GALE_INSTANTIATE_INDEX(Space, 4, std::int64_t); \
  GALE_INSTANTIATE_INDEX(Space, 3, std::int32_t); \
  GALE_INSTANTIATE_INDEX(Space, 3, std::int64_t)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE
#undef GALE_INSTANTIATE_INDEX

}  // namespace gale::detail
