#pragma once

#include <cstdint>

#include <gale/base/bits.hpp>

namespace gale::detail {

/// A set of numbers below 64 * Words. Its default constructor leaves it uninitialized, so that arrays cost nothing.
template <int Words>
class CellSet {
 public:
  static constexpr int capacity = 64 * Words;

  KOKKOS_DEFAULTED_FUNCTION CellSet() = default;

  KOKKOS_FORCEINLINE_FUNCTION static CellSet none() {
    CellSet set;
    for (int w = 0; w < Words; ++w) set.words_[w] = 0;
    return set;
  }

  KOKKOS_FORCEINLINE_FUNCTION static CellSet of(int cell) {
    CellSet set = none();
    set.add(cell);
    return set;
  }

  KOKKOS_FORCEINLINE_FUNCTION void add(int cell) { words_[cell >> 6 & (Words - 1)] |= std::uint64_t(1) << (cell & 63); }
  KOKKOS_FORCEINLINE_FUNCTION void remove_lowest() {
    for (int w = 0; w < Words; ++w) {
      if (words_[w] == 0) continue;
      words_[w] &= words_[w] - 1;
      return;
    }
  }
  KOKKOS_FORCEINLINE_FUNCTION bool has(int cell) const { return words_[cell >> 6 & (Words - 1)] >> (cell & 63) & 1; }

  KOKKOS_FORCEINLINE_FUNCTION bool empty() const {
    std::uint64_t all = 0;
    for (int w = 0; w < Words; ++w) all |= words_[w];
    return all == 0;
  }

  /// Has it exactly one member?
  KOKKOS_FORCEINLINE_FUNCTION bool is_single() const {
    CellSet rest = *this;
    rest.remove_lowest();
    return rest.empty() && !empty();
  }

  /// The lowest member; there is one.
  KOKKOS_FORCEINLINE_FUNCTION int lowest() const {
    for (int w = 0; w < Words - 1; ++w) {
      if (words_[w] != 0) return 64 * w + lowest_bit(words_[w]);
    }
    return 64 * (Words - 1) + lowest_bit(words_[Words - 1]);
  }

  KOKKOS_FORCEINLINE_FUNCTION CellSet& operator|=(const CellSet& other) {
    for (int w = 0; w < Words; ++w) words_[w] |= other.words_[w];
    return *this;
  }
  KOKKOS_FORCEINLINE_FUNCTION CellSet& operator-=(const CellSet& other) {
    for (int w = 0; w < Words; ++w) words_[w] &= ~other.words_[w];
    return *this;
  }
  friend KOKKOS_FORCEINLINE_FUNCTION CellSet operator|(CellSet a, const CellSet& b) { return a |= b; }
  friend KOKKOS_FORCEINLINE_FUNCTION CellSet operator-(CellSet a, const CellSet& b) { return a -= b; }

 private:
  std::uint64_t words_[Words];
};

// Which cells of a lower star are facets and cofacets of which. Edges are added first, each by its cell and its number
// among the edges; then triangles, then tetrahedra. A triangle gets two cofacets at most.

/// In sets: fast to read.
template <int Words>
class SetIncidences {
 public:
  using Cells = CellSet<Words>;

  KOKKOS_FORCEINLINE_FUNCTION void add_edge(int cell, int) { add(cell, Cells::none()); }
  KOKKOS_FORCEINLINE_FUNCTION void add_triangle(int cell, int, int a, int, int b) {
    add(cell, Cells::of(a) | Cells::of(b));
    cofacets_[a].add(cell);
    cofacets_[b].add(cell);
  }
  KOKKOS_FORCEINLINE_FUNCTION void add_tetrahedron(int cell, int ab, int ac, int bc) {
    add(cell, Cells::of(ab) | Cells::of(ac) | Cells::of(bc));
    cofacets_[ab].add(cell);
    cofacets_[ac].add(cell);
    cofacets_[bc].add(cell);
  }

  /// The facets of a triangle or a tetrahedron.
  KOKKOS_FORCEINLINE_FUNCTION const Cells& facets(int cell) const { return facets_[cell]; }

  /// The cofacets of any cell, which may be among them itself.
  KOKKOS_FORCEINLINE_FUNCTION const Cells& cofacets(int cell) const { return cofacets_[cell]; }

 private:
  KOKKOS_FORCEINLINE_FUNCTION void add(int cell, const Cells& facets) {
    facets_[cell] = facets;
    cofacets_[cell] = Cells::none();
  }

  Cells facets_[Cells::capacity];
  Cells cofacets_[Cells::capacity];
};

/// In four bytes a cell and a set an edge: for lanes, of which many share a cache.
template <int Words, int max_edges>
class ByteIncidences {
 public:
  using Cells = CellSet<Words>;

  /// Adds a cell that is an edge, whose number is `edge`.
  KOKKOS_FORCEINLINE_FUNCTION void add_edge(int cell, int edge) {
    cells_[cell] = Bytes(edge, 0, 0, is_edge);
    cofacets_[edge] = Cells::none();
  }

  /// Between the edges of numbers `edge_a` and `edge_b` and their cells. Its own number stands for a cofacet that isn't
  /// there.
  KOKKOS_FORCEINLINE_FUNCTION void add_triangle(int cell, int edge_a, int a, int edge_b, int b) {
    cells_[cell] = Bytes(a, b, cell, cell);
    cofacets_[edge_a].add(cell);
    cofacets_[edge_b].add(cell);
  }
  KOKKOS_FORCEINLINE_FUNCTION void add_tetrahedron(int cell, int ab, int ac, int bc) {
    cells_[cell] = Bytes(ab, ac, bc, is_tetrahedron);
    add_cofacet(ab, cell);
    add_cofacet(ac, cell);
    add_cofacet(bc, cell);
  }

  KOKKOS_FORCEINLINE_FUNCTION Cells facets(int cell) const {
    const Bytes of = cells_[cell];
    return Cells::of(of[0]) | Cells::of(of[1]) | Cells::of(of[3] == is_tetrahedron ? of[2] : of[1]);
  }
  KOKKOS_FORCEINLINE_FUNCTION Cells cofacets(int cell) const {
    const Bytes of = cells_[cell];
    if (of[3] == is_edge) return cofacets_[of[0]];
    return of[3] == is_tetrahedron ? Cells::none() : Cells::of(of[2]) | Cells::of(of[3]);
  }

 private:
  static constexpr int is_edge = 255, is_tetrahedron = 254;

  KOKKOS_FORCEINLINE_FUNCTION void add_cofacet(int triangle, int cell) {
    const Bytes of = cells_[triangle];
    cells_[triangle] = of[2] == triangle ? Bytes(of[0], of[1], cell, triangle) : Bytes(of[0], of[1], of[2], cell);
  }

  /// An edge's number; or a triangle's facets and cofacets; or a tetrahedron's facets. The last byte says what it is.
  Bytes cells_[Cells::capacity];
  Cells cofacets_[max_edges];  ///< of edges
};

}  // namespace gale::detail
