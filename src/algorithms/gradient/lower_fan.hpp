#pragma once

#include <cstdint>

#include <gale/base/bits.hpp>
#include <gale/relations/rows.hpp>

namespace gale::detail {

/// The star of a vertex of a triangle mesh, of at most so many neighbours, in which no edge has more than two
/// triangles. So its triangles make paths and rings of neighbours, and those of its lower star make paths of lower
/// neighbours, and rings where all of a ring are lower.
///
/// Pairs the cells of the lower star as `pair_cells` does, whose queues a path needs none of: its lowest edge comes
/// first, and from there each triangle is paired with the edge behind it, whichever comes next. The lowest of all edges
/// is paired with the vertex, that of any other path is critical. In a ring the two ways meet at the triangle of the
/// greatest key, since the lesser one of two goes on each time: that triangle is critical.
///
/// Vertices are named by their places in the VV row, triangles by theirs in the VF row.
template <Id max_neighbours>
class LowerFan {
  static_assert(max_neighbours <= 64, "which of them are lower is said in one word");

 public:
  /// False if the star is too large or too irregular.
  KOKKOS_INLINE_FUNCTION bool build(const std::uint64_t* keys, const VertexStar& star) {
    const Id neighbours = star.neighbours.size(), triangles = star.link.size();
    if (neighbours > max_neighbours || triangles > max_neighbours || star.link.width != 1) return false;
    const std::uint64_t key = keys[star.vertex];
    lower_ = once_ = twice_ = 0;
    for (Id i = 0; i < neighbours; ++i) {
      keys_[i] = keys[star.neighbours[i]];
      lower_ |= std::uint64_t(keys_[i] < key) << i;
      sides_[i] = 0;
    }
    std::uint64_t thrice = 0;
    const auto* const places = static_cast<const std::uint8_t*>(star.link.places);
    for (Id t = 0; t < triangles; ++t) {
      const int a = places[2 * t], b = places[2 * t + 1];
      const std::uint64_t both = bit(a) | bit(b);
      thrice |= twice_ & both;
      twice_ |= once_ & both;
      once_ |= both;
      sides_[a] = sides_[a] << 16 | static_cast<std::uint32_t>(t << 8 | b);
      sides_[b] = sides_[b] << 16 | static_cast<std::uint32_t>(t << 8 | a);
    }
    return thrice == 0;
  }

  /// Calls set_vertex(lowest): the neighbour whose edge the vertex is paired with, or -1; pair(triangle, edge, across)
  /// for each triangle that is paired with the edge to a neighbour, with the edge's other triangle or -1;
  /// critical_edge(edge) and critical_triangle(triangle) for those in no pair. `pair` may come again for a triangle,
  /// and before critical_triangle: the latest call holds.
  GALE_CALLS_ANY
  template <class SetVertex, class Pair, class CriticalEdge, class CriticalTriangle>
  KOKKOS_FORCEINLINE_FUNCTION void pair_all(const SetVertex& set_vertex, const Pair& pair,
                                            const CriticalEdge& critical_edge,
                                            const CriticalTriangle& critical_triangle) const {
    if (lower_ == 0) return set_vertex(-1);
    std::uint64_t rest = lower_;
    for (bool is_first = true; rest != 0; is_first = false) {
      const int seed = lowest_of(rest);
      rest &= ~bit(seed);
      if (is_first) {
        set_vertex(seed);
      } else {
        critical_edge(seed);
      }
      if (!walk(seed, 0, -1, rest, pair)) {
        walk(seed, 1, -1, rest, pair);
      } else {
        const int last = greatest_of_ring(seed);
        walk(seed, 1, last, rest, pair);
        critical_triangle(last);
      }
    }
  }

  /// Calls visit(triangle) for the triangles of the edge to a neighbour.
  template <class Visit>
  KOKKOS_FORCEINLINE_FUNCTION void for_each_triangle(int edge, const Visit& visit) const {
    for (int side = 0; side < 2; ++side) {
      if (has(edge, side)) visit(triangle_at(edge, side));
    }
  }

 private:
  KOKKOS_FORCEINLINE_FUNCTION static std::uint64_t bit(int place) { return std::uint64_t(1) << place; }

  /// Whether the edge to a neighbour has a triangle on that side, 0 or 1.
  KOKKOS_FORCEINLINE_FUNCTION bool has(int edge, int side) const { return (side == 0 ? once_ : twice_) >> edge & 1; }
  KOKKOS_FORCEINLINE_FUNCTION int triangle_at(int edge, int side) const {
    return sides_[edge] >> (16 * side + 8) & 255;
  }
  KOKKOS_FORCEINLINE_FUNCTION int other_at(int edge, int side) const { return sides_[edge] >> 16 * side & 255; }

  KOKKOS_FORCEINLINE_FUNCTION int lowest_of(std::uint64_t some) const {
    int lowest = lowest_bit(some);
    for (some &= some - 1; some != 0; some &= some - 1) {
      const int next = lowest_bit(some);
      lowest = keys_[next] < keys_[lowest] ? next : lowest;
    }
    return lowest;
  }

  /// The side that leads on from an edge where a triangle led there.
  KOKKOS_FORCEINLINE_FUNCTION int side_behind(int edge, int triangle) const {
    return triangle_at(edge, 0) == triangle ? 1 : 0;
  }

  /// Pairs the edges behind `seed` on one side with the triangles that lead there, as far as these are lower, and up to
  /// the triangle `last`. Whether they are a ring, which leads back.
  template <class Pair>
  KOKKOS_FORCEINLINE_FUNCTION bool walk(int seed, int side, int last, std::uint64_t& rest, const Pair& pair) const {
    for (int at = seed; has(at, side);) {
      const int triangle = triangle_at(at, side);
      at = other_at(at, side);
      if ((lower_ >> at & 1) == 0 || triangle == last) return false;
      if (at == seed) return true;
      side = side_behind(at, triangle);
      pair(triangle, at, has(at, side) ? triangle_at(at, side) : -1);
      rest &= ~bit(at);
    }
    return false;
  }

  /// The triangle of the greatest key in the ring of an edge.
  KOKKOS_FUNCTION int greatest_of_ring(int seed) const {
    int at = seed, side = 0, greatest = -1;
    std::uint64_t most_high = 0, most_low = 0;
    do {
      const int triangle = triangle_at(at, side), next = other_at(at, side);
      const std::uint64_t one = keys_[at], other = keys_[next];
      const std::uint64_t high = one > other ? one : other, low = one > other ? other : one;
      if (greatest < 0 || high > most_high || (high == most_high && low > most_low)) {
        greatest = triangle;
        most_high = high;
        most_low = low;
      }
      side = side_behind(next, triangle);
      at = next;
    } while (at != seed);
    return greatest;
  }

  std::uint64_t lower_, once_, twice_;  ///< which neighbours are lower; whose edges have a triangle, and a second one
  std::uint64_t keys_[max_neighbours];
  std::uint32_t sides_[max_neighbours];  ///< of each edge, on both sides: its triangle, and the triangle's other vertex
};

}  // namespace gale::detail
