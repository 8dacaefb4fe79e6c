#pragma once

#include <cstdint>

#include <gale/algorithms/excerpt/wall_rows.hpp>
#include <gale/algorithms/morse_smale/wall_table.hpp>
#include <gale/base/atomic.hpp>
#include <gale/base/launch_chain.hpp>
#include <gale/base/memory.hpp>

// Descending walls that grow side by side in kernels, and the ways up them.
//
// A triangle has a number: a critical one its place among these, every other one that of the edge that it is paired
// with in the table of edges, behind those of the critical ones.

namespace gale::detail {

template <class T>
using InWorkers = Array<T, WorkerMemory>;

/// A triangle of a wall; (high, low) is the edge that it is paired with, unless it is the critical one. Also a critical
/// edge that a wall ends at: then `third` is negative.
struct WallTriangle {
  Id high, low, third;
  Id wall;
};

/// A critical edge that a wall ends at.
struct WallRim {
  Id wall;
  Id high, low;
  std::uint32_t place;  ///< in the table of edges
};

/// How many kernels have found so far, the critical edges among the edges. Open are triangles that threads have left
/// open, for launches to go on from in this order.
struct WallCounts {
  Offset edges = 0, rims = 0, open = 0;
  LaunchPart part;
};

/// Where the kernels that make walls grow put what they find. Copies share it.
struct WallSink {
  Id walls;        ///< as many as critical triangles
  KeyTable edges;  ///< of walls, by `keys`
  WallEdgeKeys keys;
  InWorkers<WallTriangle> critical;   ///< by wall
  InWorkers<WallTriangle> triangles;  ///< by the places of edges
  InWorkers<std::uint32_t> open;      ///< triangles by their numbers, the critical ones first
  InWorkers<WallCounts> counts;       ///< one

  KOKKOS_FUNCTION bool is_critical(std::uint32_t number) const { return number < static_cast<std::uint32_t>(walls); }
  KOKKOS_FUNCTION std::uint32_t number_of(std::uint64_t place) const {
    return static_cast<std::uint32_t>(walls) + static_cast<std::uint32_t>(place);
  }
  KOKKOS_FUNCTION std::uint32_t place_of(std::uint32_t number) const {
    return number - static_cast<std::uint32_t>(walls);
  }
  KOKKOS_FUNCTION const WallTriangle& triangle(std::uint32_t number) const {
    return is_critical(number) ? critical(number) : triangles(place_of(number));
  }
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

/// Grows walls from open triangles in a chain of launches: a thread goes one way after the other, but for so many steps
/// alone, so that no launch waits for the longest way, and while it can keep what it comes back to. What is left then
/// is left open. Threads tell of what they have found once, at their ends: counters that all of them change at every
/// step would be what they wait for.
struct GrowWalls {
  WallRows rows;
  WallSink sink;

  KOKKOS_FUNCTION LaunchPart& part() const { return sink.counts(0).part; }
  KOKKOS_FUNCTION Offset open() const { return sink.counts(0).open; }

  /// For how many more edges and open triangles there is room.
  KOKKOS_FUNCTION Offset room() const {
    const Offset of_edges = sink.edges.room() - sink.counts(0).edges;
    const Offset of_open = static_cast<Offset>(sink.open.extent(0)) - sink.counts(0).open;
    return of_edges < of_open ? of_edges : of_open;
  }

  KOKKOS_FUNCTION void go_on(Offset i, int steps) const {
    const LaneMask lanes = lanes_here();
    ThreadStack<std::uint32_t, 24> open;
    Offset edges = 0, rims = 0;
    std::uint32_t number = sink.open(i);
    WallTriangle triangle = sink.triangle(number);
    for (int step = 0; step < steps && number != none && open.has_room_for(3); ++step) {
      WallSide sides[3];
      std::uint64_t there[3];
      int count = 0;
      for_each_side(rows, triangle, sink.is_critical(number), [&](const WallSide& side) {
        sides[count] = side;
        there[count++] = sink.edges.first_there(sink.keys(triangle.wall, side.edge.number));
      });
      for (int k = 0; k < count; ++k)
        there[k] = sink.edges.claim(sink.keys(triangle.wall, sides[k].edge.number), there[k]);
      std::uint32_t next = none;
      WallTriangle next_triangle{};
      for (int k = 0; k < count; ++k) {
        const WallTriangle behind{sides[k].high, sides[k].low, sides[k].edge.third, triangle.wall};
        const std::uint32_t to = come_to(behind, sides[k].edge.number, there[k], edges, rims);
        if (to == none) continue;
        if (next != none) open.push(next);
        next = to;
        next_triangle = behind;
      }
      if (next == none && !open.is_empty()) {
        next = open.pop();
        next_triangle = sink.triangle(next);
      }
      number = next;
      triangle = next_triangle;
    }
    if (number != none) open.push(number);
    meet(lanes);
    open.append_to(sink.open, &sink.counts(0).open);
    add_in_turn(&sink.counts(0).edges, edges);
    add_in_turn(&sink.counts(0).rims, rims);
  }

 private:
  static constexpr std::uint32_t none = ~std::uint32_t(0);

  /// Comes to what is behind an edge, by its number, where the table's claim() was `there`. Returns the number of
  /// a triangle that the wall grows on from, or none.
  KOKKOS_FUNCTION std::uint32_t come_to(const WallTriangle& behind, Offset edge, std::uint64_t there, Offset& edges,
                                        Offset& rims) const {
    bool is_new = false;
    const std::uint64_t place = sink.edges.insert(sink.keys(behind.wall, edge), there, is_new);
    if (!is_new) return none;
    sink.triangles(place) = behind;
    ++edges;
    if (behind.third >= 0) return sink.number_of(place);
    ++rims;
    return none;
  }
};

/// Walls that have grown.
struct GrownWalls {
  WallRows rows;
  WallSink sink;
  WallTable table;
  InWorkers<WallRim> rims;  ///< in no order

  /// Says of a triangle which edges it is above, or puts a critical edge among the rims: with each of the critical
  /// triangles and of the places of the table, in any order.
  KOKKOS_FUNCTION void finish(Offset i) const {
    const auto number = static_cast<std::uint32_t>(i);
    const bool is_critical = sink.is_critical(number);
    if (!is_critical && sink.edges.at(sink.place_of(number)) == KeyTable::none) return;
    const WallTriangle from = sink.triangle(number);
    if (from.third < 0) {
      rims(atomic_add(&sink.counts(0).rims, Offset(-1)) - 1) = {from.wall, from.high, from.low, sink.place_of(number)};
      return;
    }
    for_each_side(rows, from, is_critical, [&](const WallSide& side) {
      table.put_above(sink.edges.find(sink.keys(from.wall, side.edge.number)), number,
                      [this](std::uint32_t a, std::uint32_t b) { return is_less(a, b); });
    });
  }

  /// Calls visit(triangle, are_several) with each triangle on the way up from a rim, by its number, and whether there
  /// are more where it was taken.
  template <class Visit>
  KOKKOS_FUNCTION void climb(const WallRim& rim, const Visit& visit) const {
    for (std::uint32_t place = rim.place;;) {
      const std::uint32_t triangle = table.least_above(place);
      visit(triangle, table.are_several_above(place));
      if (sink.is_critical(triangle)) return;
      place = sink.place_of(triangle);
    }
  }

 private:
  /// Is one triangle before another, both by their numbers, written with their input vertices ascending?
  KOKKOS_FUNCTION bool is_less(std::uint32_t a, std::uint32_t b) const {
    Id first[3], second[3];
    write(sink.triangle(a), first);
    write(sink.triangle(b), second);
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
