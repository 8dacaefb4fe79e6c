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

/// How many kernels have found so far. Open are triangles that threads have left open, for launches to go on from in
/// this order.
struct WallCounts {
  Offset triangles = 0, rims = 0, open = 0;
};

/// Where the kernels that make walls grow put what they find. Copies share it.
struct WallSink {
  KeyTable edges;  ///< of walls, by `keys`
  WallEdgeKeys keys;
  InWorkers<WallTriangle> triangles;  ///< the critical ones first
  InWorkers<WallRim> rims;
  InWorkers<std::uint32_t> open;  ///< triangles by their numbers, the critical ones first
  InWorkers<WallCounts> counts;   ///< one
};

/// A side of a wall's triangle, the higher end first.
struct WallSide {
  Id high, low;
  PairedEdge edge;
};

/// Calls visit(side) for the sides of a wall's triangle that lead on from it: those that are paired with vertices lead
/// nowhere. All are looked up before the first visit, so that their loads are under way together.
template <class Visit>
KOKKOS_FUNCTION void for_each_side(const WallRows& rows, const WallTriangle& triangle, bool is_critical,
                                   const Visit& visit) {
  const bool in_order = rows.keys[triangle.low] > rows.keys[triangle.third];
  WallSide sides[] = {{in_order ? triangle.low : triangle.third, in_order ? triangle.third : triangle.low, {}},
                      {triangle.high, triangle.third, {}},
                      {triangle.high, triangle.low, {0, edge_has_vertex}}};
  for (int i = 0; i < 3; ++i) {
    if (i < 2 || is_critical) sides[i].edge = rows.edge(sides[i].high, sides[i].low);
  }
  for (int i = 0; i < 3; ++i) {
    if (sides[i].edge.third != edge_has_vertex) visit(sides[i]);
  }
}

/// Grows walls from an open triangle, one thread of a launch: on along one way as long as there is room, but
/// `most_steps` at most, so that triangles that were left open don't wait for the longest way. Where ways part, and
/// where it ends, triangles are left open.
struct GrowWalls {
  WallRows rows;
  WallSink sink;
  Id walls;
  Offset first, threads;  ///< of `open`, in this launch
  Offset most_triangles;  ///< to come to while others may be left open

  static constexpr Offset most_sides = 3;
  static constexpr int most_steps = 16;

  KOKKOS_FUNCTION void operator()(Offset i) const {
    std::uint32_t number = sink.open(first + i);
    WallTriangle triangle = sink.triangles(number);
    for (int step = 0; number != none; ++step) {
      if (step == most_steps || (step > 0 && !has_room())) return leave_open(number);
      std::uint32_t next = none;
      WallTriangle next_triangle{};
      for_each_side(rows, triangle, number < static_cast<std::uint32_t>(walls), [&](const WallSide& side) {
        if (!come_to(triangle.wall, side)) return;
        leave_open(next);
        next_triangle = {side.high, side.low, side.edge.third, triangle.wall};
        next = static_cast<std::uint32_t>(atomic_add(&sink.counts(0).triangles, Offset(1)));
        sink.triangles(next) = next_triangle;
      });
      number = next;
      triangle = next_triangle;
    }
  }

 private:
  static constexpr std::uint32_t none = ~std::uint32_t(0);

  /// Comes to a side. Does the wall grow on behind it?
  KOKKOS_FUNCTION bool come_to(Id wall, const WallSide& side) const {
    bool is_new = false;
    sink.edges.insert(sink.keys(wall, side.edge.number), is_new);
    if (!is_new || side.edge.third >= 0) return is_new;
    sink.rims(atomic_add(&sink.counts(0).rims, Offset(1))) = {wall, side.high, side.low};
    return false;
  }

  KOKKOS_FUNCTION void leave_open(std::uint32_t number) const {
    if (number != none) sink.open(atomic_add(&sink.counts(0).open, Offset(1))) = number;
  }

  /// Is there room for a step of each thread?
  KOKKOS_FUNCTION bool has_room() const {
    const WallCounts& counts = sink.counts(0);
    const Offset more = most_sides * threads;
    const Offset triangles = atomic_read(&counts.triangles) + more, rims = atomic_read(&counts.rims) + more;
    return triangles <= most_triangles && detail::has_room(sink.triangles, triangles) &&
           detail::has_room(sink.rims, rims) && detail::has_room(sink.open, atomic_read(&counts.open) + more) &&
           sink.edges.has_room(triangles + rims);
  }
};

/// Walls that have grown.
struct GrownWalls {
  WallRows rows;
  InWorkers<WallTriangle> triangles;  ///< the critical ones first
  Id walls;
  WallTable table;

  /// Says of one triangle which edges it is above.
  KOKKOS_FUNCTION void put_above(Offset triangle) const {
    const auto number = static_cast<std::uint32_t>(triangle);
    const WallTriangle from = triangles(triangle);
    for_each_side(rows, from, triangle < walls, [&](const WallSide& side) {
      table.put_above(table.find(from.wall, side.edge.number), number,
                      [this](std::uint32_t a, std::uint32_t b) { return is_less(a, b); });
    });
  }

  /// Calls visit(triangle, are_several) with each triangle on the way up from a rim, by its number, and whether there
  /// are more where it was taken.
  template <class Visit>
  KOKKOS_FUNCTION void climb(const WallRim& rim, const Visit& visit) const {
    for (Id high = rim.high, low = rim.low;;) {
      const std::uint64_t at = table.find(rim.wall, rows.edge(high, low).number);
      const std::uint32_t triangle = table.least_above(at);
      visit(triangle, table.are_several_above(at));
      if (triangle < static_cast<std::uint32_t>(walls)) return;
      high = triangles(triangle).high;
      low = triangles(triangle).low;
    }
  }

 private:
  /// Is one triangle before another, both by their numbers, written with their input vertices ascending?
  KOKKOS_FUNCTION bool is_less(std::uint32_t a, std::uint32_t b) const {
    Id first[3], second[3];
    write(triangles(a), first);
    write(triangles(b), second);
    for (int i = 0; i < 2; ++i) {
      if (first[i] != second[i]) return first[i] < second[i];
    }
    return first[2] < second[2];
  }

  KOKKOS_FUNCTION void write(const WallTriangle& triangle, Id (&written)[3]) const {
    const Id ids[] = {rows.names[triangle.high], rows.names[triangle.low], rows.names[triangle.third]};
    for (int i = 0; i < 3; ++i) written[(ids[0] < ids[i]) + (ids[1] < ids[i]) + (ids[2] < ids[i])] = ids[i];
  }
};

}  // namespace gale::detail
