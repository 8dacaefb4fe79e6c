#pragma once

#include <cstdint>

#include <gale/base/bits.hpp>
#include <gale/relations/rows.hpp>

namespace gale::detail {

// The link of a vertex has its neighbours as vertices. Two of them have an edge in it if they share a triangle with the
// vertex, and each tetrahedron of the vertex is a triangle of it. So a triangle of the vertex that has one tetrahedron
// only, one on the mesh's surface, is an edge of the link with one triangle only. On a triangle mesh, an edge of the
// vertex that has one triangle only, one on the boundary, is a vertex of the link with one edge only.

/// What the link of a vertex says of it.
struct LinkTopology {
  int lower = 0;            ///< connected components of the lower neighbours
  int upper = 0;            ///< connected components of the upper neighbours
  bool on_surface = false;  ///< on a triangle with exactly one tetrahedron, or an edge with one triangle
};

/// The link of a vertex that has no more neighbours than a Word has bits: for each of them a word, with a bit for each
/// neighbour that shares an edge of the link with it. Refers to memory of the caller's.
template <class Bits>
class LinkBits {
 public:
  using Word = Bits;
  static constexpr Id capacity = 8 * sizeof(Word);

  /// In two words a neighbour.
  KOKKOS_FORCEINLINE_FUNCTION LinkBits(Word* words, Id neighbours, const LinkRow& link)
      : once_(words), twice_(words + neighbours) {
    for (Id i = 0; i < neighbours; ++i) once_[i] = twice_[i] = 0;
    if (link.others == 2) {
      add_edges(neighbours, link);
      return;
    }
    for (Id t = 0; t < link.size(); ++t) {
      const Id a = link.template of<3>(t, 0), b = link.template of<3>(t, 1), c = link.template of<3>(t, 2);
      const Word bit_a = Word(1) << a, bit_b = Word(1) << b, bit_c = Word(1) << c;
      join(a, bit_b | bit_c);
      join(b, bit_a | bit_c);
      join(c, bit_a | bit_b);
    }
    for (Id i = 0; i < neighbours; ++i) open_ |= once_[i] & ~twice_[i];
  }

  /// Has the link an edge with one triangle only, or, of triangles, a vertex with one edge only?
  KOKKOS_FORCEINLINE_FUNCTION bool is_open() const { return open_ != 0; }

  /// The neighbours that share an edge of the link with the i-th one.
  KOKKOS_FORCEINLINE_FUNCTION Word touching(Id i) const { return once_[i]; }

  /// Calls visit(i) for one neighbour of each connected component of a set of neighbours, which it finds by flooding.
  template <class Visit>
  KOKKOS_FORCEINLINE_FUNCTION void for_each_component(Word rest, const Visit& visit) const {
    while (rest != 0) {
      Word front = rest & (~rest + 1);
      rest &= ~front;
      visit(lowest_bit(front));
      while (front != 0) {
        const Word met = once_[lowest_bit(front)] & rest;
        front = (front & (front - 1)) | met;
        rest &= ~met;
      }
    }
  }

  /// Connected components of a set of neighbours.
  KOKKOS_FORCEINLINE_FUNCTION int components(Word rest) const {
    int count = 0;
    for_each_component(rest, [&](int) { ++count; });
    return count;
  }

  /// Classifies the vertex. `lower` has a bit for each neighbour below it, in VV order.
  KOKKOS_FORCEINLINE_FUNCTION LinkTopology topology(Id neighbours, Word lower) const {
    const Word all = neighbours == capacity ? ~Word(0) : (Word(1) << neighbours) - 1;
    return {components(lower), components(all & ~lower), is_open()};
  }

 private:
  /// Takes the link of a vertex on a triangle mesh.
  KOKKOS_FORCEINLINE_FUNCTION void add_edges(Id neighbours, const LinkRow& link) {
    for (Id t = 0; t < link.size(); ++t) {
      const Id a = link.template of<2>(t, 0), b = link.template of<2>(t, 1);
      once_[a] |= Word(1) << b;
      once_[b] |= Word(1) << a;
    }
    for (Id i = 0; i < neighbours; ++i) open_ |= Word(once_[i] != 0 && (once_[i] & (once_[i] - 1)) == 0);
  }

  KOKKOS_FORCEINLINE_FUNCTION void join(Id to, Word others) {
    twice_[to] |= once_[to] & others;
    once_[to] |= others;
  }

  Word* once_;
  Word* twice_;
  Word open_ = 0;
};

/// The link of a vertex with at most 64 neighbours as bits, with the memory that these take.
class SmallLink {
 public:
  using Word = std::uint64_t;
  static constexpr Id capacity = LinkBits<std::uint64_t>::capacity;

  KOKKOS_FUNCTION SmallLink(Id neighbours, const LinkRow& link) : bits_(words_, neighbours, link) {}
  SmallLink(const SmallLink&) = delete;
  SmallLink& operator=(const SmallLink&) = delete;

  KOKKOS_FUNCTION bool is_open() const { return bits_.is_open(); }
  KOKKOS_FORCEINLINE_FUNCTION std::uint64_t touching(Id i) const { return bits_.touching(i); }
  KOKKOS_FORCEINLINE_FUNCTION int components(std::uint64_t of) const { return bits_.components(of); }
  template <class Visit>
  KOKKOS_FORCEINLINE_FUNCTION void for_each_component(std::uint64_t of, const Visit& visit) const {
    bits_.for_each_component(of, visit);
  }
  KOKKOS_FORCEINLINE_FUNCTION LinkTopology topology(Id neighbours, std::uint64_t lower) const {
    return bits_.topology(neighbours, lower);
  }

 private:
  std::uint64_t words_[2 * capacity];
  LinkBits<std::uint64_t> bits_;
};

/// The neighbours below a vertex, by their places in its VV row; they are no more than a Word has bits.
template <class Word>
KOKKOS_FORCEINLINE_FUNCTION Word lower_neighbours(const std::uint64_t* keys, Id vertex, const Row& neighbours) {
  const std::uint64_t key = keys[vertex];
  Word lower = 0;
  for (Id i = 0; i < neighbours.size(); ++i) lower |= Word(keys[neighbours[i]] < key) << i;
  return lower;
}

}  // namespace gale::detail
