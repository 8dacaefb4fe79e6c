#pragma once

#include <cstdint>
#include <type_traits>

#include <gale/algorithms/gradient/cell_set.hpp>
#include <gale/algorithms/gradient/lower_neighbours.hpp>

namespace gale::detail {

/// The lower star of a vertex: itself, and the edges, triangles and tetrahedra in which no other vertex is higher. Its
/// cells but the vertex are numbered in the order of their keys: the ranks of their other vertices, descending,
/// compared lexicographically. So the lowest bit of a set is the head of a queue.
///
/// The other vertices are named by their ranks among the lower neighbours, 0 the lowest. A triangle (a, b), a > b, is
/// that of the vertex and its lower neighbours of ranks a and b; likewise a tetrahedron (a, b, c).
///
/// Holds stars of at most max_edges edges and 64 * Words cells in which no triangle has more than two tetrahedra.
/// Mispredicted branches are what this costs most, so there are few of them: what belongs to an upper vertex is written
/// too, to a place that nobody reads.
template <int Words>
class LowerStar {
 public:
  using Cells = CellSet<Words>;

  static constexpr int max_edges = Words == 1 ? 16 : 64;
  static constexpr std::uint8_t none = LowerNeighbours::none;
  static constexpr int no_place = -1;
  static constexpr bool may_fork = false;  ///< whether a triangle may have more than two tetrahedra

  /// False if the star is too large or too irregular.
  KOKKOS_INLINE_FUNCTION bool build(const LowerNeighbours& lower, const LinkRow& link) {
    edges_ = lower.count();
    if (edges_ > max_edges || link.width != 1 || link.size() > max_star) return false;
    find_wedges(lower.ranks(), static_cast<const std::uint8_t*>(link.places), link.size());
    if (!number_triangles() || !find_cofaces() || edges_ + triangles_ + tetrahedra_ > Cells::capacity) return false;
    number_cells();
    connect_triangles();
    connect_tetrahedra();
    return true;
  }

  KOKKOS_FORCEINLINE_FUNCTION int edges() const { return edges_; }
  KOKKOS_FORCEINLINE_FUNCTION int cells() const { return cells_; }
  KOKKOS_FORCEINLINE_FUNCTION const Cells& all_edges() const { return all_edges_; }
  KOKKOS_FORCEINLINE_FUNCTION const Cells& facets(int cell) const { return facets_[cell]; }
  KOKKOS_FORCEINLINE_FUNCTION const Cells& cofacets(int cell) const { return cofacets_[cell]; }

  /// Dimension of a cell: 1 to 3.
  KOKKOS_FORCEINLINE_FUNCTION int dimension(int cell) const {
    return corner_[cell][1] == none ? 1 : corner_[cell][2] == none ? 2 : 3;
  }

  /// Ranks of a cell's vertices, descending; as many as it has dimensions.
  KOKKOS_FORCEINLINE_FUNCTION const std::uint8_t* corners(int cell) const { return corner_[cell]; }

  /// Place of a tetrahedron in the VT row.
  KOKKOS_FORCEINLINE_FUNCTION int place(int tetrahedron) const { return place_[tetrahedron]; }

  /// Place in the VT row of a triangle's tetrahedron that isn't the one at `place`; `no_place` if there is no other.
  KOKKOS_FORCEINLINE_FUNCTION int across(int triangle, int place) const {
    const Cofaces cofaces = cofaces_[triangle_of(triangle)];
    return cofaces.count() == 1 ? no_place : cofaces.places() - place;
  }

  /// Calls visit(place) for the places in the VT row of a triangle's tetrahedra.
  template <class Visit>
  KOKKOS_FORCEINLINE_FUNCTION void for_each_tetrahedron(int triangle, const Visit& visit) const {
    const int high = corner_[triangle][0], low = corner_[triangle][1];
    for (int i = 0; i < wedges_; ++i) {
      const Wedge& w = wedge_[i];
      if ((w.a == high) + (w.b == high) + (w.b == low) + (w.c == low) == 2) visit(w.place);
    }
  }

 private:
  static constexpr int max_triangles = Cells::capacity;
  static constexpr int max_star = 128;  ///< tetrahedra of the vertex

  /// For one lower neighbour a, a bit for each b that has a triangle (a, b). A word holds those of several a, so that
  /// one loop finds all their triangles.
  using Below = std::conditional_t<Words == 1, std::uint16_t, std::uint64_t>;
  static constexpr int below_bits = 8 * sizeof(Below);
  static constexpr int below_in_word = 64 / below_bits;

  /// A tetrahedron of the star with at least two lower vertices: their ranks, descending, the first `none` where it has
  /// two only.
  struct Wedge {
    std::uint8_t a, b, c, place;
  };

  /// A triangle's tetrahedra in the whole star of the vertex, added up: how many there are; their places in VT; the
  /// ranks of their third vertices; and how many are in the lower star with a third vertex below the triangle's.
  class Cofaces {
   public:
    KOKKOS_FORCEINLINE_FUNCTION void clear() { sums_ = 0; }
    KOKKOS_FORCEINLINE_FUNCTION void add(int third, int place, int is_below) {
      sums_ +=
          std::uint64_t(is_below) << 48 | std::uint64_t(1) << 32 | std::uint64_t(third) << 16 | std::uint64_t(place);
    }
    KOKKOS_FORCEINLINE_FUNCTION int count() const { return static_cast<int>(sums_ >> 32 & 0xffff); }
    KOKKOS_FORCEINLINE_FUNCTION int below() const { return static_cast<int>(sums_ >> 48); }
    KOKKOS_FORCEINLINE_FUNCTION int thirds() const { return static_cast<int>(sums_ >> 16 & 0xffff); }
    KOKKOS_FORCEINLINE_FUNCTION int places() const { return static_cast<int>(sums_ & 0xffff); }

   private:
    std::uint64_t sums_;
  };

  /// A tetrahedron (a, b, c) by its triangles (a, b), (a, c), (b, c).
  struct Tetrahedron {
    std::uint8_t ab, ac, bc, c, place;
  };

  KOKKOS_FORCEINLINE_FUNCTION void find_wedges(const std::uint8_t* ranks, const std::uint8_t* places, int star) {
    std::uint8_t x[max_star], y[max_star], z[max_star];
    for (int t = 0; t < star; ++t) {
      x[t] = ranks[places[3 * t]];
      y[t] = ranks[places[3 * t + 1]];
      z[t] = ranks[places[3 * t + 2]];
    }
    for (int t = 0; t < star; ++t) {  // many at once, where the processor can
      const std::uint8_t low = x[t] < y[t] ? x[t] : y[t], high = x[t] < y[t] ? y[t] : x[t];
      const std::uint8_t a = high > z[t] ? high : z[t], c = low < z[t] ? low : z[t];
      y[t] = x[t] ^ y[t] ^ z[t] ^ a ^ c;
      x[t] = a;
      z[t] = c;
    }
    int count = 0;
    for (int t = 0; t < star; ++t) {
      wedge_[count] = {x[t], y[t], z[t], static_cast<std::uint8_t>(t)};
      count += y[t] != none;
    }
    wedges_ = count;
  }

  /// Numbers the triangles of the wedges in the order of their keys. False if there are too many.
  KOKKOS_FORCEINLINE_FUNCTION bool number_triangles() {
    for (int a = 0; a < edges_; ++a) triangles_end_[a] = 0;
    for (int a = 0; a < max_edges && a < edges_ + below_in_word; ++a) below_[a] = 0;
    for (int i = 0; i < wedges_; ++i) {
      const Wedge w = wedge_[i];
      const Below bit_b = static_cast<Below>(Below(1) << (w.b % below_bits)),
                  bit_c = static_cast<Below>(Below(1) << (w.c % below_bits));
      below_[w.b] |= bit_c;
      below_[w.a] |= bit_b | bit_c;
    }
    int count = 0;
    for (int first = 0; first < edges_; first += below_in_word) {
      std::uint64_t rest = 0;
      for (int i = 0; i < below_in_word; ++i) rest |= std::uint64_t(below_[first + i]) << (i * below_bits % 64);
      for (; rest != 0; rest &= rest - 1) {
        const int bit = lowest_bit(rest), a = first + bit / below_bits, b = bit % below_bits;
        if (count == max_triangles) return false;
        high_[count] = static_cast<std::uint8_t>(a);
        low_[count] = static_cast<std::uint8_t>(b);
        cofaces_[count].clear();
        triangle_at_[a][b] = static_cast<std::uint8_t>(count);
        triangles_end_[a] = static_cast<std::uint8_t>(++count);
      }
    }
    triangles_ = count;
    for (int b = 0; b < edges_; ++b) triangle_at_[none][b] = max_triangles;
    return true;
  }

  /// Finds the tetrahedra of all triangles, and those in the lower star. False if a triangle has more than two.
  KOKKOS_FORCEINLINE_FUNCTION bool find_cofaces() {
    int count = 0;
    for (int i = 0; i < wedges_; ++i) {
      const Wedge w = wedge_[i];
      const std::uint8_t ab = triangle_at_[w.a][w.b], ac = triangle_at_[w.a][w.c], bc = triangle_at_[w.b][w.c];
      cofaces_[bc].add(w.a, w.place, 0);
      cofaces_[ab].add(w.c, w.place, 1);
      cofaces_[ac].add(w.b, w.place, 0);
      tetrahedron_[count] = {ab, ac, bc, w.c, w.place};
      count += w.a != none;
    }
    tetrahedra_ = count;
    int most = 0;
    for (int i = 0; i < triangles_; ++i) most = cofaces_[i].count() > most ? cofaces_[i].count() : most;
    return most <= 2;
  }

  /// Numbers each edge, then its triangles, each before the tetrahedra that begin with it.
  KOKKOS_FORCEINLINE_FUNCTION void number_cells() {
    cells_ = edges_ + triangles_ + tetrahedra_;
    all_edges_ = Cells::none();
    int before = 0;  // tetrahedra
    for (int i = 0; i < triangles_; ++i) {
      triangle_cell_[i] = static_cast<std::uint8_t>(high_[i] + 1 + i + before);
      before += cofaces_[i].below();
      tetrahedra_end_[i + 1] = static_cast<std::uint8_t>(before);
    }
    tetrahedra_end_[0] = 0;
    int triangles = 0;
    for (int a = 0; a < edges_; ++a) {
      const int cell = a + triangles + tetrahedra_end_[triangles];
      edge_cell_[a] = static_cast<std::uint8_t>(cell);
      all_edges_.add(cell);
      set_cell(cell, a, none, none);
      facets_[cell] = Cells::none();
      triangles = triangles_end_[a] > triangles ? triangles_end_[a] : triangles;
    }
  }

  KOKKOS_FORCEINLINE_FUNCTION void connect_triangles() {
    for (int i = 0; i < triangles_; ++i) {
      const int cell = triangle_cell_[i], a = edge_cell_[high_[i]], b = edge_cell_[low_[i]];
      set_cell(cell, high_[i], low_[i], none);
      facets_[cell] = Cells::of(a) | Cells::of(b);
      cofacets_[a].add(cell);
      cofacets_[b].add(cell);
    }
  }

  KOKKOS_FORCEINLINE_FUNCTION void connect_tetrahedra() {
    for (int i = 0; i < tetrahedra_; ++i) {
      const Tetrahedron& t = tetrahedron_[i];
      const int ab = triangle_cell_[t.ab], ac = triangle_cell_[t.ac], bc = triangle_cell_[t.bc];
      const Cofaces& cofaces = cofaces_[t.ab];
      // The other tetrahedron of (a, b) comes before if its third vertex is lower.
      const int cell = ab + 1 + (cofaces.count() == 2 && cofaces.thirds() - t.c < t.c);
      set_cell(cell, high_[t.ab], low_[t.ab], t.c);
      place_[cell] = t.place;
      facets_[cell] = Cells::of(ab) | Cells::of(ac) | Cells::of(bc);
      cofacets_[ab].add(cell);
      cofacets_[ac].add(cell);
      cofacets_[bc].add(cell);
    }
  }

  KOKKOS_FORCEINLINE_FUNCTION void set_cell(int cell, int a, int b, int c) {
    corner_[cell][0] = static_cast<std::uint8_t>(a);
    corner_[cell][1] = static_cast<std::uint8_t>(b);
    corner_[cell][2] = static_cast<std::uint8_t>(c);
    cofacets_[cell] = Cells::none();
  }

  KOKKOS_FORCEINLINE_FUNCTION int triangle_of(int cell) const {
    return triangle_at_[corner_[cell][0]][corner_[cell][1]];
  }

  int edges_, triangles_, tetrahedra_, wedges_, cells_;
  Cells all_edges_;
  Cells facets_[Cells::capacity];
  Cells cofacets_[Cells::capacity];
  std::uint8_t corner_[Cells::capacity][4];
  std::uint8_t place_[Cells::capacity];
  Below below_[none + 1];
  std::uint8_t triangle_at_[none + 1][max_edges];
  std::uint8_t edge_cell_[max_edges];
  std::uint8_t triangles_end_[max_edges];  ///< one past the last triangle (a, b) of each a; 0 where it has none
  std::uint8_t high_[max_triangles], low_[max_triangles];
  std::uint8_t triangle_cell_[max_triangles];
  std::uint8_t tetrahedra_end_[max_triangles + 1];  ///< how many tetrahedra begin with a triangle before this
  Cofaces cofaces_[max_triangles + 1];
  Tetrahedron tetrahedron_[max_star + 1];
  Wedge wedge_[max_star + 1];
};

}  // namespace gale::detail
