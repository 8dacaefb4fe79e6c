#pragma once

#include <cstdint>

#include <gale/algorithms/excerpt/wall_rows.hpp>
#include <gale/algorithms/morse_smale/wall_table.hpp>
#include <gale/base/atomic.hpp>
#include <gale/base/memory.hpp>

// Descending walls that grow side by side in kernels, and the ways up them.

namespace gale::detail {

template <class T>
using InWorkers = Array<T, WorkerMemory>;

/// A triangle of a wall; (high, low) is the edge that it is paired with, unless it is the critical one.
struct WallTriangle {
  Id high, low, third;
  Id wall;
};

/// A critical edge that a wall ends at.
struct WallRim {
  Id wall;
  Id high, low;
};

/// How many a kernel has found so far.
struct WallCounts {
  Offset triangles = 0, edges = 0, rims = 0;
};

/// Where the kernels that make walls grow put what they find. Copies share it.
struct WallSink {
  WallTable table;
  InWorkers<WallTriangle> triangles;  ///< the critical ones first
  InWorkers<WallRim> rims;
  InWorkers<WallCounts> counts;  ///< one
};

/// Crosses the edges of one triangle. Those that are paired with vertices lead nowhere, and are left out.
struct CrossSides {
  WallRows rows;
  WallSink sink;
  Id walls;

  KOKKOS_FUNCTION void operator()(Offset triangle) const {
    const auto number = static_cast<std::uint32_t>(triangle);
    const WallTriangle from = sink.triangles(triangle);
    if (triangle < walls) cross(from.high, from.low, from.wall, number);
    cross(from.high, from.third, from.wall, number);
    const bool in_order = rows.keys[from.low] > rows.keys[from.third];
    cross(in_order ? from.low : from.third, in_order ? from.third : from.low, from.wall, number);
  }

  /// Is one triangle before another, both by their numbers, written with their input vertices ascending?
  KOKKOS_FUNCTION bool is_less(std::uint32_t a, std::uint32_t b) const {
    Id first[3], second[3];
    write(sink.triangles(a), first);
    write(sink.triangles(b), second);
    for (int i = 0; i < 2; ++i) {
      if (first[i] != second[i]) return first[i] < second[i];
    }
    return first[2] < second[2];
  }

 private:
  KOKKOS_FUNCTION void write(const WallTriangle& triangle, Id (&written)[3]) const {
    const Id ids[] = {rows.names[triangle.high], rows.names[triangle.low], rows.names[triangle.third]};
    for (int i = 0; i < 3; ++i) written[(ids[0] < ids[i]) + (ids[1] < ids[i]) + (ids[2] < ids[i])] = ids[i];
  }

  KOKKOS_FUNCTION void cross(Id high, Id low, Id wall, std::uint32_t from) const {
    const PairedEdge edge = rows.edge(high, low);
    if (edge.third == edge_has_vertex) return;
    bool is_new = false;
    const std::uint64_t at = sink.table.insert(wall, edge.number, is_new);
    sink.table.put_above(at, from, [this](std::uint32_t a, std::uint32_t b) { return is_less(a, b); });
    if (!is_new) return;
    atomic_add(&sink.counts(0).edges, Offset(1));
    if (edge.third >= 0) {
      sink.triangles(atomic_add(&sink.counts(0).triangles, Offset(1))) = {high, low, edge.third, wall};
    } else {
      sink.rims(atomic_add(&sink.counts(0).rims, Offset(1))) = {wall, high, low};
    }
  }
};

/// Calls visit(triangle, are_several) with each triangle on the way up from a rim, by its number, and whether there are
/// more where it was taken.
template <class Visit>
KOKKOS_FUNCTION void climb(const CrossSides& walls, const WallRim& rim, const Visit& visit) {
  const WallTable& table = walls.sink.table;
  for (Id high = rim.high, low = rim.low;;) {
    const std::uint64_t at = table.find(rim.wall, walls.rows.edge(high, low).number);
    const std::uint32_t triangle = table.least_above(at);
    visit(triangle, table.are_several_above(at));
    if (triangle < static_cast<std::uint32_t>(walls.walls)) return;
    high = walls.sink.triangles(triangle).high;
    low = walls.sink.triangles(triangle).low;
  }
}

}  // namespace gale::detail
