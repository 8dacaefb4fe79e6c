#include <algorithm>
#include <cstdint>
#include <vector>

#include <gale/base/error.hpp>
#include <gale/base/ordered.hpp>
#include <gale/base/transfer.hpp>
#include <gale/distributed/sharing/local_corners.hpp>

namespace gale::detail {

namespace {

/// Writes the local input ids of the vertices of cells first..last-1 from `to` on.
template <class Index>
void write_corners(const LocalCells<Index>& cells, const LocalVertices& vertices, Offset first, Offset last, Id* to) {
  constexpr Offset block = 256;
  const IndexInterval<Index> owned(vertices.interval());
  const GlobalId shift = vertices.interval().is_empty() ? 0 : vertices.owned(0) - vertices.interval().begin;
  cells.visit(first, last, [&](Offset, const Index* corners, Offset count) {
    const Offset entries = cells.corners() * count;
    for (Offset begin = 0; begin < entries; begin += block) {
      const Offset size = std::min(block, entries - begin);
      if (owned.contains(corners + begin, size)) {
        for (Offset k = 0; k < size; ++k) to[k] = static_cast<Id>(corners[begin + k] + shift);
      } else {
        for (Offset k = 0; k < size; ++k) to[k] = vertices.find(corners[begin + k]);
      }
      to += size;
    }
  });
}

/// Cells by their places among all: their vertices' local input ids, in rows of four.
template <class Memory>
struct PlacedRows {
  Array<Id, Memory> places;
  Array<Quad, Memory> rows;
};

/// The cells that have no row of their own: kept ones with vertices outside the interval, and received ones.
template <class Index>
PlacedRows<HostMemory> rows_beside(const LocalCells<Index>& cells, const LocalVertices& vertices,
                                   const std::vector<CellRun>& runs) {
  const CellPlaces& places = cells.places();
  const Offset outer = cells.outer().extent(0), count = outer + cells.received_count();
  const PlacedRows<HostMemory> beside{allocate<Array<Id, HostMemory>>("GALE::places_beside", count),
                                      allocate<Array<Quad, HostMemory>>("GALE::rows_beside", count)};
  with_constant(cells.corners(), [&](auto corners) {
    const auto put = [&](Offset at, Offset place, const Index* cell) {
      beside.places(at) = static_cast<Id>(place);
      beside.rows(at) = {vertices.find(cell[0]), vertices.find(cell[1]), vertices.find(cell[2]),
                         vertices.find(cell[corners - 1])};
    };
    parallel_for("GALE::outer_rows", HostExecutionSpace(), outer, [&](Offset k) {
      const Id place = cells.outer()(k);
      const auto behind = std::upper_bound(runs.begin(), runs.end(), place,
                                           [](Id place, const CellRun& run) { return place < run.place; });
      const CellRun& run = *(behind - 1);
      put(k, run.begin + (place - run.place), cells.part_vertices(place));
    });
    places.visit_received([&](Offset i, Offset r) { put(outer + r, i, cells.received_vertices(r)); });
  });
  return beside;
}

/// Writes a cell's first vertices to its place among all.
template <int corners>
KOKKOS_FORCEINLINE_FUNCTION void put_corners(Id* all, Offset place, const Quad& row) {
  if constexpr (corners == 4) {
    reinterpret_cast<Quad*>(all)[place] = row;
  } else {
    for (int k = 0; k < corners; ++k) all[corners * place + k] = row[k];
  }
}

/// Writes the i-th of all cells if it is of a run, and adds to the places of its vertices.
template <int corners, class Memory>
struct MoveRun {
  Array<const Quad, Memory> rows;
  Array<const CellRun, Memory> runs;
  Id first_vertex;
  Id* to;

  KOKKOS_FUNCTION void operator()(Offset i) const {
    const auto count = static_cast<Offset>(runs.extent(0));
    const Offset behind = bisect(Offset(0), count, [&](Offset r) { return runs(r).begin <= i; });
    if (behind == 0) return;
    const CellRun run = runs(behind - 1);
    if (i - run.begin >= run.count) return;
    const Quad row = load_four(&rows(run.place + (i - run.begin)));
    put_corners<corners>(to, i,
                         {row.a + first_vertex, row.b + first_vertex, row.c + first_vertex, row.d + first_vertex});
  }
};

/// Writes a cell to its place.
template <int corners, class Memory>
struct PutRow {
  PlacedRows<Memory> placed;
  Id* to;

  KOKKOS_FUNCTION void operator()(Offset i) const { put_corners<corners>(to, placed.places(i), placed.rows(i)); }
};

}  // namespace

template <class Space, class Index>
CornersIn<MemoryOf<Space>> corners_of_rows(const Space& space, const LocalCells<Index>& cells,
                                           const LocalVertices& vertices,
                                           const Array<const Quad, MemoryOf<Space>>& rows) {
  using Here = MemoryOf<Space>;
  const auto runs = cells.places().runs();
  const auto runs_here = in_memory<Here>(runs);
  const auto all = allocate<CornersIn<Here>>("GALE::local_cells", cells.count(), cells.corners());
  const Id first_vertex = vertices.owned(0);
  with_constant(cells.corners(), [&](auto corners) {
    parallel_for("GALE::move_cells", space, cells.count(),
                 MoveRun<corners, Here>{rows, runs_here, first_vertex, all.data()});
    const PlacedRows<HostMemory> beside = rows_beside(cells, vertices, runs);
    const PlacedRows<Here> here{in_memory<Here>(beside.places), in_memory<Here>(beside.rows)};
    parallel_for("GALE::put_cells", space, here.places.extent(0), PutRow<corners, Here>{here, all.data()});
    space.fence();
  });
  return all;
}

template <class Space, class Index>
CornersIn<MemoryOf<Space>> corners_in(const Space& space, const LocalCells<Index>& cells, const LocalVertices& vertices,
                                      [[maybe_unused]] Array<const Quad, WorkerMemory> rows) {
  const Offset count = cells.count(), corners = cells.corners();
  if constexpr (is_device<Space>) {
    if (rows.extent(0) > 0 && cells.places().keep_order()) {
      try {
        return corners_of_rows(space, cells, vertices, rows);
      } catch (const OutOfMemory&) {
        // There may be room for them without rows beside.
      }
    }
    rows = {};
  }
  const auto all = allocate<CornersIn<MemoryOf<Space>>>("GALE::local_cells", count, corners);
  if constexpr (!is_device<Space>) {
    for_parts("GALE::local_cells", count, threads_for(count), [&](int, Offset first, Offset last) {
      write_corners(cells, vertices, first, last, all.data() + corners * first);
    });
  } else if (corners == 4) {
    constexpr std::size_t row = 4 * sizeof(Id);
    write_to_device(all.data(), static_cast<std::size_t>(count) * row,
                    [&](char* to, std::size_t begin, std::size_t size) {
                      write_corners(cells, vertices, static_cast<Offset>(begin / row),
                                    static_cast<Offset>((begin + size) / row), reinterpret_cast<Id*>(to));
                    });
  } else {  // chunks would end within rows
    copy_to_device(all.data(), local_corners(cells, vertices).data(), all.size() * sizeof(Id));
  }
  return all;
}

template <class Index>
CellRows<Id> local_corners(const LocalCells<Index>& cells, const LocalVertices& vertices) {
  return corners_in(HostExecutionSpace(), cells, vertices, {});
}

#define GALE_INSTANTIATE_INDEX(Space, Index)                                                                        \
  template CornersIn<MemoryOf<Space>> corners_of_rows(const Space&, const LocalCells<Index>&, const LocalVertices&, \
                                                      const Array<const Quad, MemoryOf<Space>>&);                   \
  template CornersIn<MemoryOf<Space>> corners_in(const Space&, const LocalCells<Index>&, const LocalVertices&,      \
                                                 Array<const Quad, WorkerMemory>)
#define GALE_INSTANTIATE(Space)                \
  GALE_INSTANTIATE_INDEX(Space, std::int32_t); \
  GALE_INSTANTIATE_INDEX(Space, std::int64_t)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE
#undef GALE_INSTANTIATE_INDEX
template CellRows<Id> local_corners(const LocalCells<std::int32_t>&, const LocalVertices&);
template CellRows<Id> local_corners(const LocalCells<std::int64_t>&, const LocalVertices&);

}  // namespace gale::detail
