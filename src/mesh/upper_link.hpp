#pragma once

#include <gale/base/bits.hpp>
#include <gale/mesh/simplices.hpp>

namespace gale::detail {

/// The higher neighbours of a vertex (the ends of its own edges, by their places), and which of them make a triangle
/// with it and each other: for each, a bit for each higher one. In one thread's own memory.
class UpperLink {
 public:
  /// Higher neighbours that a vertex may have.
  static constexpr Id capacity = 64;

  /// `middle(visit)` calls visit(t) for each tetrahedron of which the vertex is second or third.
  template <class Memory, class Middle>
  KOKKOS_INLINE_FUNCTION UpperLink(const Simplices<Memory>& simplices, Id vertex, const Middle& middle)
      : neighbours_(simplices.edge_high.data() + simplices.edge_begin(vertex)),
        count_(simplices.edge_begin(vertex + 1) - simplices.edge_begin(vertex)) {
    for (Id i = 0; i < count_; ++i) joined_[i] = 0;
    for (Id t = simplices.tetrahedron_begin(vertex); t < simplices.tetrahedron_begin(vertex + 1); ++t) {
      const Quad quad = simplices.tetrahedron(t);
      const Id b = place_of(quad.b, 0), c = place_of(quad.c, b), d = place_of(quad.d, c);
      joined_[b] |= bit(c) | bit(d);
      joined_[c] |= bit(d);
    }
    middle([&](Id t) {
      const Quad quad = simplices.tetrahedron(t);
      if (quad.b != vertex) return;
      const Id c = place_of(quad.c, 0);
      joined_[c] |= bit(place_of(quad.d, c));
    });
  }

  KOKKOS_INLINE_FUNCTION Id size() const { return count_; }

  /// How many triangles the i-th edge has with higher vertices.
  KOKKOS_INLINE_FUNCTION Id triangles(Id i) const {
    return count_bits(static_cast<std::uint32_t>(joined_[i])) +
           count_bits(static_cast<std::uint32_t>(joined_[i] >> 32));
  }

  /// Calls visit(apex) for each of them, ascending.
  template <class Visit>
  KOKKOS_INLINE_FUNCTION void for_each_apex(Id i, const Visit& visit) const {
    for (Id j = i + 1; j < count_; ++j) {
      if (joined_[i] >> j & 1) visit(neighbours_[j]);
    }
  }

 private:
  KOKKOS_FORCEINLINE_FUNCTION static std::uint64_t bit(Id i) { return std::uint64_t(1) << i; }

  /// The place of a neighbour that is there, not before `from`.
  KOKKOS_FORCEINLINE_FUNCTION Id place_of(Id neighbour, Id from) const {
    while (neighbours_[from] != neighbour) ++from;
    return from;
  }

  const Id* neighbours_;
  Id count_;
  std::uint64_t joined_[capacity];
};

}  // namespace gale::detail
