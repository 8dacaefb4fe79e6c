#pragma once

#include <cstdint>

#include <gale/algorithms/detail/cell_set.hpp>
#include <gale/algorithms/detail/lower_neighbours.hpp>

namespace gale::detail {

/// The lower star of a vertex: itself, and the edges, triangles and tetrahedra in which no other vertex is higher. Its cells but the vertex are numbered in
/// the order of their keys: the ranks of their other vertices, descending, compared lexicographically. So the lowest bit of a set is the head of a queue.
///
/// The other vertices are named by their ranks among the lower neighbours, 0 the lowest. A triangle (a, b), a > b, is that of the vertex and its lower
/// neighbours of ranks a and b; likewise a tetrahedron (a, b, c).
///
/// Holds stars of at most 64 * Words cells in which no triangle has more than two tetrahedra. Branches that a processor couldn't foresee are the cost of all this, so there are
/// few: what is of no use, because a vertex is upper, is written where nobody reads it.
template <int Words>
class LowerStar {
 public:
  using Cells = CellSet<Words>;

  static constexpr std::uint8_t none = LowerNeighbours::none;
  static constexpr int no_place = -1;

  /// False if the star is too large or too irregular.
  KOKKOS_INLINE_FUNCTION bool build(const LowerNeighbours& lower, const LinkRow& link) {
    edges_ = lower.count();
    if (edges_ > max_edges || link.width != 1 || link.size() > max_star) return false;
    find_wedges(lower.ranks(), static_cast<const std::uint8_t*>(link.places), link.size());
    return number_triangles() && find_cofaces() && number_cells() && (connect_triangles(), connect_tetrahedra(), true);
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

  /// Place in the VT row of a triangle's tetrahedron that isn't the one at `place`; `no_place` if there is no other.
  KOKKOS_FORCEINLINE_FUNCTION int across(int triangle, int place) const {
    const Triangle& t = triangle_of(triangle);
    return t.count == 1 ? no_place : t.place[t.place[0] == place ? 1 : 0];
  }

  /// Calls visit(place) for the places in the VT row of a triangle's tetrahedra.
  template <class Visit>
  KOKKOS_FORCEINLINE_FUNCTION void for_each_tetrahedron(int triangle, const Visit& visit) const {
    const Triangle& t = triangle_of(triangle);
    for (int i = 0; i < t.count; ++i) visit(t.place[i]);
  }

 private:
  static constexpr int max_edges = 32 * Words;
  static constexpr int max_triangles = Cells::capacity;
  static constexpr int max_star = 128;  ///< tetrahedra of the vertex
  static constexpr int unread = max_triangles;

  /// A triangle's tetrahedra in the whole star of the vertex: where they are in VT, and the rank of each one's third vertex.
  struct Triangle {
    std::uint8_t count;
    std::uint8_t cell;
    std::uint8_t high, low;
    std::uint8_t third[4];
    std::uint8_t place[4];
  };

  /// A tetrahedron of the star with at least two lower vertices: their ranks, descending, the first `none` where it has two only.
  struct Wedge {
    std::uint8_t a, b, c, place;
  };

  /// A tetrahedron (a, b, c) by its triangles (a, b), (a, c), (b, c).
  struct Tetrahedron {
    std::uint8_t ab, ac, bc, c, place;
  };

  /// The wedges, and which triangles they have.
  KOKKOS_FORCEINLINE_FUNCTION void find_wedges(const std::uint8_t* ranks, const std::uint8_t* places, int star) {
    for (int a = 0; a < edges_; ++a) below_[a] = 0;
    wedges_ = 0;
    for (int t = 0; t < star; ++t, places += 3) {
      const int x = ranks[places[0]], y = ranks[places[1]], z = ranks[places[2]];
      const int low = x < y ? x : y, high = x < y ? y : x;
      const int a = high > z ? high : z, c = low < z ? low : z, b = x + y + z - a - c;
      wedge_[wedges_] = {static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b), static_cast<std::uint8_t>(c), static_cast<std::uint8_t>(t)};
      wedges_ += b != none;
      const std::uint64_t bit_b = std::uint64_t(1) << (b & 63), bit_c = std::uint64_t(1) << (c & 63);
      below_[b] |= bit_c;
      below_[a] |= bit_b | bit_c;
    }
  }

  /// In the order of their keys.
  KOKKOS_FORCEINLINE_FUNCTION bool number_triangles() {
    int count = 0;
    for (int a = 0; a < edges_; ++a) {
      for (std::uint64_t rest = below_[a]; rest != 0; rest &= rest - 1) {
        if (count == max_triangles) return false;
        const int b = lowest_bit(rest);
        triangle_at_[a][b] = static_cast<std::uint8_t>(count);
        triangle_[count].count = 0;
        triangle_[count].high = static_cast<std::uint8_t>(a);
        triangle_[count].low = static_cast<std::uint8_t>(b);
        ++count;
      }
    }
    for (int b = 0; b < edges_; ++b) triangle_at_[none][b] = unread;
    triangles_ = count;
    return true;
  }

  /// The tetrahedra of all triangles, and which of them are in the lower star.
  KOKKOS_FORCEINLINE_FUNCTION bool find_cofaces() {
    tetrahedra_ = 0;
    for (int i = 0; i < triangles_; ++i) begins_[i] = 0;
    triangle_[unread].count = 0;
    for (int i = 0; i < wedges_; ++i) {
      const Wedge w = wedge_[i];
      const int ab = triangle_at_[w.a][w.b], ac = triangle_at_[w.a][w.c], bc = triangle_at_[w.b][w.c];
      add_coface(bc, w.a, w.place);
      add_coface(ab, w.c, w.place);
      add_coface(ac, w.b, w.place);
      ++begins_[ab];
      tetrahedron_[tetrahedra_] = {static_cast<std::uint8_t>(ab), static_cast<std::uint8_t>(ac), static_cast<std::uint8_t>(bc), w.c, w.place};
      tetrahedra_ += w.a != none;
    }
    int most = 0;
    for (int i = 0; i < triangles_; ++i) most = triangle_[i].count > most ? triangle_[i].count : most;
    return most <= 2;
  }

  KOKKOS_FORCEINLINE_FUNCTION void add_coface(int triangle, std::uint8_t third, std::uint8_t place) {
    Triangle& t = triangle_[triangle];
    t.third[t.count & 3] = third;
    t.place[t.count & 3] = place;
    ++t.count;
  }

  /// Each edge, then its triangles, each before the tetrahedra that begin with it.
  KOKKOS_FORCEINLINE_FUNCTION bool number_cells() {
    cells_ = edges_ + triangles_ + tetrahedra_;
    if (cells_ > Cells::capacity) return false;
    all_edges_ = Cells::none();
    int cell = 0, edge = -1;
    for (int i = 0; i < triangles_; ++i) {
      for (; edge < triangle_[i].high; add_edge(++edge, cell++)) {
      }
      triangle_[i].cell = static_cast<std::uint8_t>(cell);
      cell += 1 + begins_[i];
    }
    while (edge + 1 < edges_) add_edge(++edge, cell++);
    return true;
  }

  KOKKOS_FORCEINLINE_FUNCTION void add_edge(int edge, int cell) {
    edge_cell_[edge] = static_cast<std::uint8_t>(cell);
    all_edges_.add(cell);
    set_cell(cell, edge, none, none);
    facets_[cell] = Cells::none();
  }

  KOKKOS_FORCEINLINE_FUNCTION void connect_triangles() {
    for (int i = 0; i < triangles_; ++i) {
      const Triangle& t = triangle_[i];
      set_cell(t.cell, t.high, t.low, none);
      facets_[t.cell] = Cells::none();
      connect(t.cell, edge_cell_[t.high]);
      connect(t.cell, edge_cell_[t.low]);
    }
  }

  KOKKOS_FORCEINLINE_FUNCTION void connect_tetrahedra() {
    for (int i = 0; i < tetrahedra_; ++i) {
      const Tetrahedron& t = tetrahedron_[i];
      const Triangle& first = triangle_[t.ab];
      const int other = first.place[0] == t.place ? 1 : 0;  // the triangle's other tetrahedron comes before, if it is one of these with a lower third vertex
      const int cell = first.cell + 1 + (other < first.count && first.third[other] < t.c);
      set_cell(cell, first.high, first.low, t.c);
      place_[cell] = t.place;
      facets_[cell] = Cells::none();
      connect(cell, first.cell);
      connect(cell, triangle_[t.ac].cell);
      connect(cell, triangle_[t.bc].cell);
    }
  }

  KOKKOS_FORCEINLINE_FUNCTION void set_cell(int cell, int a, int b, int c) {
    corner_[cell][0] = static_cast<std::uint8_t>(a);
    corner_[cell][1] = static_cast<std::uint8_t>(b);
    corner_[cell][2] = static_cast<std::uint8_t>(c);
    cofacets_[cell] = Cells::none();
  }

  KOKKOS_FORCEINLINE_FUNCTION void connect(int cell, int facet) {
    facets_[cell].add(facet);
    cofacets_[facet].add(cell);
  }

  KOKKOS_FORCEINLINE_FUNCTION const Triangle& triangle_of(int cell) const { return triangle_[triangle_at_[corner_[cell][0]][corner_[cell][1]]]; }

  int edges_, triangles_, tetrahedra_, wedges_, cells_;
  Cells all_edges_;
  Cells facets_[Cells::capacity];
  Cells cofacets_[Cells::capacity];
  std::uint8_t corner_[Cells::capacity][4];
  std::uint8_t place_[Cells::capacity];
  std::uint64_t below_[none + 1];  ///< for each a those b with a triangle (a, b)
  std::uint8_t triangle_at_[none + 1][max_edges];
  std::uint8_t begins_[max_triangles + 1];  ///< how many tetrahedra begin with a triangle
  std::uint8_t edge_cell_[max_edges];
  Triangle triangle_[max_triangles + 1];
  Tetrahedron tetrahedron_[max_star + 1];
  Wedge wedge_[max_star + 1];
};

}  // namespace gale::detail
