#pragma once

#include <gale/algorithms/gradient/large_lower_star.hpp>
#include <gale/algorithms/gradient/lower_fan.hpp>
#include <gale/algorithms/gradient/lower_neighbours.hpp>
#include <gale/algorithms/gradient/pair_star.hpp>

namespace gale::detail {

/// The successor of the triangle at `place`, which is paired with its edge (vertex, low) on the rim of the mesh.
KOKKOS_INLINE_FUNCTION Id rim_successor(const VertexStar& star, Id place, Id low) {
  const Id first = star.neighbours[star.link(place, 0)], second = star.neighbours[star.link(place, 1)];
  const int corner = first == low ? 1 : 0;
  return outside(corner + ((corner == 0 ? first : second) > star.vertex ? 1 : 0));
}

// An edge is paired with a vertex or with a triangle, and both know it: nothing else is written.

/// Pairs the lower star of any vertex of a triangle mesh and puts what it finds into `sink`. `lower` are its lower
/// neighbours.
template <class Sink>
void pair_large_fan(const Sink& sink, const VertexStar& star, const ManyLowerNeighbours& lower, LargeLowerStar& cells) {
  const auto id = [&](int rank) { return star.neighbours[lower.place(lower.with_rank(rank))]; };
  sink.set_vertex(star.vertex, lower.count() == 0 ? no_id : id(0));
  if (lower.count() == 0) return;
  const auto pair = [&](int edge, int cell) {
    const Id place = cells.place(cell), across = cells.across(edge, place);
    sink.set_cell(star.cells[place],
                  across == no_id ? rim_successor(star, place, id(cells.corners(edge)[0])) : star.cells[across]);
    cells.for_each_place(edge, [&](Id other) {
      if (other != place && other != across) sink.add_successor(star.cells[place], star.cells[other]);
    });
  };
  const auto critical = [&](int cell) {
    if (cells.dimension(cell) == 2) return sink.add_critical_cell(star.cells[cells.place(cell)]);
    const Id low = id(cells.corners(cell)[0]);
    sink.add_critical_edge(star.vertex, low);
    cells.for_each_place(cell, [&](Id place) { sink.add_to_star({star.vertex, low, no_id}, star.cells[place]); });
  };
  pair_cells(cells, pair, critical);
}

/// Pairs the lower star of a vertex of at most so many neighbours, whose triangles make paths and rings; false if it
/// has more, or is irregular.
GALE_CALLS_ANY
template <Id max_neighbours = 64, class Sink>
KOKKOS_FUNCTION bool pair_small_fan(const Sink& sink, const std::uint64_t* keys, const VertexStar& star) {
  LowerFan<max_neighbours> fan;
  if (!fan.build(keys, star)) return false;
  fan.pair_all([&](int lowest) { sink.set_vertex(star.vertex, lowest < 0 ? no_id : star.neighbours[lowest]); },
               [&](int triangle, int edge, int across) {
                 sink.set_cell(star.cells[triangle],
                               across < 0 ? rim_successor(star, triangle, star.neighbours[edge]) : star.cells[across]);
               },
               [&](int edge) {
                 const Id low = star.neighbours[edge];
                 sink.add_critical_edge(star.vertex, low);
                 fan.for_each_triangle(edge, [&](int triangle) {
                   sink.add_to_star({star.vertex, low, no_id}, star.cells[triangle]);
                 });
               },
               [&](int triangle) { sink.add_critical_cell(star.cells[triangle]); });
  return true;
}

}  // namespace gale::detail
