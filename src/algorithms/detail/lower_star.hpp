#pragma once

#include <cstdint>

#include <gale/algorithms/detail/cell_set.hpp>
#include <gale/relations/rows.hpp>

namespace gale::detail {

/// The lower star of a vertex: itself, and the edges, triangles and tetrahedra in which no other vertex is higher. Its cells but the vertex are numbered in
/// the order of their keys: the ranks of their other vertices, descending, compared lexicographically. So the lowest bit of a set is the head of a queue.
///
/// The other vertices are named by their ranks among the lower neighbours, 0 the lowest. A triangle (a, b), a > b, is that of the vertex and its lower
/// neighbours of ranks a and b; likewise a tetrahedron (a, b, c).
///
/// Holds stars of at most 64 * Words cells in which no triangle has more than two tetrahedra.
template <int Words>
class LowerStar {
 public:
  using Cells = CellSet<Words>;

  static constexpr int max_neighbours = 128;    ///< of the vertex, lower or not
  static constexpr int max_edges = 32 * Words;
  static constexpr int max_triangles = Cells::capacity;
  static constexpr std::uint8_t none = 255;

  /// `ranks`: for each neighbour in VV order its rank among the `edges` lower ones, or `none` for an upper one; `edges` is at most max_edges. False if the
  /// star is too large or too irregular.
  KOKKOS_INLINE_FUNCTION bool build(const std::uint8_t* ranks, int edges, const LinkRow& link) {
    edges_ = edges;
    return find_triangles(ranks, link) && find_cofaces(ranks, link) && number_cells();
  }

  KOKKOS_FORCEINLINE_FUNCTION int edges() const { return edges_; }
  KOKKOS_FORCEINLINE_FUNCTION int cells() const { return cells_; }
  KOKKOS_FORCEINLINE_FUNCTION const Cells& all_edges() const { return all_edges_; }
  KOKKOS_FORCEINLINE_FUNCTION const Cells& facets(int cell) const { return facets_[cell]; }
  KOKKOS_FORCEINLINE_FUNCTION const Cells& cofacets(int cell) const { return cofacets_[cell]; }

  /// Dimension of a cell: 1 to 3.
  KOKKOS_FORCEINLINE_FUNCTION int dimension(int cell) const { return corner_[cell][1] == none ? 1 : corner_[cell][2] == none ? 2 : 3; }

  /// Ranks of a cell's vertices, descending; as many as it has dimensions.
  KOKKOS_FORCEINLINE_FUNCTION const std::uint8_t* corners(int cell) const { return corner_[cell]; }

  /// Place of a tetrahedron in the VT row.
  KOKKOS_FORCEINLINE_FUNCTION int place(int tetrahedron) const { return place_[tetrahedron]; }

  /// Place in the VT row of a triangle's tetrahedron that isn't the one at `place`; `none` if there is no other.
  KOKKOS_FORCEINLINE_FUNCTION int across(int triangle, int place) const {
    const Triangle& t = triangle_of(triangle);
    return t.place[0] == place ? t.place[1] : t.place[0];
  }

  /// Calls visit(place) for the places in the VT row of a triangle's tetrahedra.
  template <class Visit>
  KOKKOS_FORCEINLINE_FUNCTION void for_each_tetrahedron(int triangle, const Visit& visit) const {
    for (const std::uint8_t place : triangle_of(triangle).place) {
      if (place != none) visit(place);
    }
  }

 private:
  /// Its tetrahedra in the whole star of the vertex: where they are in VT, and the rank of each one's third vertex.
  struct Triangle {
    std::uint8_t third[2] = {none, none};
    std::uint8_t place[2] = {none, none};
    std::uint8_t cell = 0;
  };

  KOKKOS_FORCEINLINE_FUNCTION const Triangle& triangle_of(int cell) const { return triangles_[triangle_at_[corner_[cell][0]][corner_[cell][1]]]; }

  /// Three ranks, descending, so that upper ones come first.
  struct Corners {
    std::uint8_t a, b, c;

    KOKKOS_FORCEINLINE_FUNCTION Corners(const std::uint8_t* ranks, const LinkRow& link, Id t) {
      const std::uint8_t x = ranks[link(t, 0)], y = ranks[link(t, 1)], z = ranks[link(t, 2)];
      const std::uint8_t low = x < y ? x : y, high = x < y ? y : x;
      a = high > z ? high : z;
      c = low < z ? low : z;
      b = static_cast<std::uint8_t>(x ^ y ^ z ^ a ^ c);
    }
  };

  /// Which triangles there are; numbers them in the order of their keys.
  KOKKOS_INLINE_FUNCTION bool find_triangles(const std::uint8_t* ranks, const LinkRow& link) {
    if (link.size() >= none) return false;
    std::uint64_t below[max_edges];  // those b with a triangle (a, b)
    for (int a = 0; a < edges_; ++a) below[a] = 0;
    for (Id t = 0; t < link.size(); ++t) {
      const Corners corners(ranks, link, t);
      if (corners.b == none) continue;
      const std::uint64_t bit_c = std::uint64_t(1) << corners.c;
      below[corners.b] |= bit_c;
      if (corners.a != none) below[corners.a] |= bit_c | std::uint64_t(1) << corners.b;
    }
    int count = 0;
    for (int a = 0; a < edges_; ++a) {
      first_triangle_[a] = static_cast<std::uint8_t>(count);
      for (std::uint64_t rest = below[a]; rest != 0; rest &= rest - 1) {
        if (count == max_triangles) return false;
        const int b = lowest_bit(rest);
        triangle_at_[a][b] = static_cast<std::uint8_t>(count);
        low_[count] = static_cast<std::uint8_t>(b);
        triangles_[count++] = Triangle();
      }
    }
    first_triangle_[edges_] = static_cast<std::uint8_t>(count);
    return true;
  }

  KOKKOS_INLINE_FUNCTION bool find_cofaces(const std::uint8_t* ranks, const LinkRow& link) {
    for (Id t = 0; t < link.size(); ++t) {
      const Corners corners(ranks, link, t);
      if (corners.b == none) continue;
      if (!add_coface(corners.b, corners.c, corners.a, t)) return false;
      if (corners.a == none) continue;
      if (!add_coface(corners.a, corners.b, corners.c, t) || !add_coface(corners.a, corners.c, corners.b, t)) return false;
    }
    return true;
  }

  KOKKOS_FORCEINLINE_FUNCTION bool add_coface(int a, int b, std::uint8_t third, Id t) {
    Triangle& triangle = triangles_[triangle_at_[a][b]];
    const int slot = triangle.place[0] == none ? 0 : 1;
    if (triangle.place[slot] != none) return false;
    triangle.place[slot] = static_cast<std::uint8_t>(t);
    triangle.third[slot] = third;
    return true;
  }

  KOKKOS_INLINE_FUNCTION bool number_cells() {
    cells_ = 0;
    all_edges_ = Cells();
    for (int a = 0; a < edges_; ++a) {
      if (cells_ + 1 + 3 * (first_triangle_[a + 1] - first_triangle_[a]) > Cells::capacity) return false;
      edge_cell_[a] = static_cast<std::uint8_t>(cells_);
      all_edges_.add(cells_);
      add_cell(a, none, none);
      for (int i = first_triangle_[a]; i < first_triangle_[a + 1]; ++i) number_triangle(a, i);
    }
    return true;
  }

  /// A triangle, and its tetrahedra whose third vertex is lower than its two.
  KOKKOS_FORCEINLINE_FUNCTION void number_triangle(int a, int i) {
    Triangle& triangle = triangles_[i];
    const int b = low_[i];
    triangle.cell = static_cast<std::uint8_t>(add_cell(a, b, none));
    connect(triangle.cell, edge_cell_[a]);
    connect(triangle.cell, edge_cell_[b]);
    const int first = triangle.third[0] < triangle.third[1] ? 0 : 1;
    if (triangle.third[first] < b) add_tetrahedron(a, b, triangle, first);
    if (triangle.third[1 - first] < b) add_tetrahedron(a, b, triangle, 1 - first);
  }

  KOKKOS_FORCEINLINE_FUNCTION void add_tetrahedron(int a, int b, const Triangle& triangle, int slot) {
    const int c = triangle.third[slot];
    const int cell = add_cell(a, b, c);
    place_[cell] = triangle.place[slot];
    connect(cell, triangle.cell);
    connect(cell, triangles_[triangle_at_[a][c]].cell);
    connect(cell, triangles_[triangle_at_[b][c]].cell);
  }

  KOKKOS_FORCEINLINE_FUNCTION int add_cell(int a, int b, int c) {
    corner_[cells_][0] = static_cast<std::uint8_t>(a);
    corner_[cells_][1] = static_cast<std::uint8_t>(b);
    corner_[cells_][2] = static_cast<std::uint8_t>(c);
    facets_[cells_] = cofacets_[cells_] = Cells();
    return cells_++;
  }

  KOKKOS_FORCEINLINE_FUNCTION void connect(int cell, int facet) {
    facets_[cell].add(facet);
    cofacets_[facet].add(cell);
  }

  int edges_;
  int cells_;
  Cells all_edges_;
  Cells facets_[Cells::capacity];
  Cells cofacets_[Cells::capacity];
  std::uint8_t corner_[Cells::capacity][3];
  std::uint8_t place_[Cells::capacity];
  std::uint8_t edge_cell_[max_edges];
  std::uint8_t first_triangle_[max_edges + 1];
  std::uint8_t triangle_at_[max_edges][max_edges];
  std::uint8_t low_[max_triangles];
  Triangle triangles_[max_triangles];
};

}  // namespace gale::detail
