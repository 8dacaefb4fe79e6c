#pragma once

#include <cstdint>

#include <gale/base/bits.hpp>
#include <gale/relations/rows.hpp>

namespace gale::detail {

// The link of a vertex has its neighbours as vertices. Two of them have an edge in it if they share a triangle with the
// vertex, and each tetrahedron of the vertex is a triangle of it. So a triangle of the vertex that has one tetrahedron
// only, one on the mesh's surface, is an edge of the link with one triangle only.

/// What the link of a vertex says of it.
struct LinkTopology {
  int lower = 0;            ///< connected components of the lower neighbours
  int upper = 0;            ///< connected components of the upper neighbours
  bool on_surface = false;  ///< it belongs to a triangle with exactly one tetrahedron
};

/// The link of a vertex with at most 64 neighbours: for each of them a word, with a bit for each neighbour that shares
/// an edge of the link with it.
class SmallLink {
 public:
  static constexpr Id capacity = 64;

  KOKKOS_FUNCTION SmallLink(Id neighbours, const LinkRow& link) {
    for (Id i = 0; i < neighbours; ++i) once_[i] = twice_[i] = 0;
    for (Id t = 0; t < link.size(); ++t) {
      const Id a = link(t, 0), b = link(t, 1), c = link(t, 2);
      const std::uint64_t bit_a = std::uint64_t(1) << a, bit_b = std::uint64_t(1) << b, bit_c = std::uint64_t(1) << c;
      join(a, bit_b | bit_c);
      join(b, bit_a | bit_c);
      join(c, bit_a | bit_b);
    }
    for (Id i = 0; i < neighbours; ++i) open_ |= once_[i] & ~twice_[i];
  }

  /// Has the link an edge with one triangle only?
  KOKKOS_FUNCTION bool is_open() const { return open_ != 0; }

  /// The neighbours that share an edge of the link with the i-th one.
  KOKKOS_FORCEINLINE_FUNCTION std::uint64_t touching(Id i) const { return once_[i]; }

  /// Connected components of a set of neighbours, by flooding.
  KOKKOS_FUNCTION int components(std::uint64_t rest) const {
    int count = 0;
    while (rest != 0) {
      std::uint64_t front = rest & (~rest + 1);
      rest &= ~front;
      while (front != 0) {
        const std::uint64_t met = once_[lowest_bit(front)] & rest;
        front = (front & (front - 1)) | met;
        rest &= ~met;
      }
      ++count;
    }
    return count;
  }

 private:
  KOKKOS_FORCEINLINE_FUNCTION void join(Id to, std::uint64_t others) {
    twice_[to] |= once_[to] & others;
    once_[to] |= others;
  }

  std::uint64_t once_[capacity];
  std::uint64_t twice_[capacity];
  std::uint64_t open_ = 0;
};

/// Classifies a vertex with at most SmallLink::capacity neighbours. `lower` has a bit for each neighbour below it, in
/// VV order.
KOKKOS_INLINE_FUNCTION LinkTopology small_topology(Id neighbours, const LinkRow& link, std::uint64_t lower) {
  const SmallLink small(neighbours, link);
  const std::uint64_t all = neighbours == 64 ? ~std::uint64_t(0) : (std::uint64_t(1) << neighbours) - 1;
  return {small.components(lower), small.components(all & ~lower), small.is_open()};
}

}  // namespace gale::detail
