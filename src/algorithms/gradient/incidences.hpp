#pragma once

#include <gale/algorithms/gradient/cell_set.hpp>
#include <gale/base/bits.hpp>

// Which cells of a lower star are facets and cofacets of which. Edges are added first, each by its cell and its number
// among the edges; then triangles, then tetrahedra. A triangle gets two cofacets at most.

namespace gale::detail {

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
