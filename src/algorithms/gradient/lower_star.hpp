#pragma once

#include <cstdint>
#include <type_traits>

#include <gale/algorithms/gradient/incidences.hpp>
#include <gale/algorithms/gradient/lower_neighbours.hpp>
#include <gale/base/bits.hpp>

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
/// too, to a place that nobody reads. With `is_small` it takes less memory and a little more arithmetic: for lanes,
/// which have many in the cache at a time.
template <int Words, bool is_small = false>
class LowerStar {
 public:
  using Cells = CellSet<Words>;

  static constexpr int max_edges = Words == 1 ? 16 : 64;
  static constexpr std::uint8_t none = LowerNeighbours::none;
  static constexpr int no_place = -1;
  static constexpr bool may_fork = false;  ///< whether a triangle may have more than two tetrahedra
  static constexpr bool may_leave = true;  ///< or only one

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

  /// The facets of a triangle or a tetrahedron.
  KOKKOS_FORCEINLINE_FUNCTION Cells facets(int cell) const { return incidences_.facets(cell); }

  /// The cofacets of any cell, which may be among them itself.
  KOKKOS_FORCEINLINE_FUNCTION Cells cofacets(int cell) const { return incidences_.cofacets(cell); }

  /// Dimension of a cell: 1 to 3.
  KOKKOS_FORCEINLINE_FUNCTION int dimension(int cell) const {
    const Bytes all = corners(cell);
    return all[1] == none ? 1 : all[2] == none ? 2 : 3;
  }

  /// Ranks of a cell's vertices, descending; as many as it has dimensions.
  KOKKOS_FORCEINLINE_FUNCTION Bytes corners(int cell) const { return cell_[cell]; }

  /// Place of a tetrahedron in the VT row.
  KOKKOS_FORCEINLINE_FUNCTION int place(int tetrahedron) const { return cell_[tetrahedron][3]; }

  /// Place in the VT row of a triangle's tetrahedron that isn't the one at `place`; `no_place` if there is no other.
  KOKKOS_FORCEINLINE_FUNCTION int across(int triangle, int place) const {
    const Bytes corner = corners(triangle);
    const Cofaces cofaces = cofaces_[triangle_at_[corner[0]][corner[1]]];
    return cofaces.count() == 1 ? no_place : cofaces.places() - place;
  }

  /// Calls visit(place) for the places in the VT row of a triangle's tetrahedra.
  template <class Visit>
  KOKKOS_FORCEINLINE_FUNCTION void for_each_place(int triangle, const Visit& visit) const {
    const Bytes corner = corners(triangle);
    const int high = corner[0], low = corner[1];
    for (int i = 0; i < wedges_; ++i) {
      const Bytes wedge = wedge_[i];
      if ((wedge[0] == high) + (wedge[1] == high) + (wedge[1] == low) + (wedge[2] == low) == 2) visit(wedge[3]);
    }
  }

 private:
  using Incidences = std::conditional_t<is_small, ByteIncidences<Words, max_edges>, SetIncidences<Words>>;

  static constexpr int max_triangles = Cells::capacity;
  static constexpr int max_star = 128;  ///< tetrahedra of the vertex

  /// For one lower neighbour a, a bit for each b that has a triangle (a, b). A word holds those of several a, so that
  /// one loop finds all their triangles.
  using Below = std::conditional_t<Words == 1, std::uint16_t, std::uint64_t>;
  static constexpr int below_bits = 8 * sizeof(Below);
  static constexpr int below_in_word = 64 / below_bits;

  /// A triangle's tetrahedra in the whole star of the vertex, added up: how many there are; their places in VT; the
  /// ranks of their third vertices; and how many are in the lower star with a third vertex below the triangle's.
  class Cofaces {
   public:
    KOKKOS_FORCEINLINE_FUNCTION void clear() { sums_ = 0; }
    KOKKOS_FORCEINLINE_FUNCTION void add(int third, int place, int is_below) {
      sums_ += static_cast<std::uint32_t>(is_below << 24 | 1 << 16 | third << 8 | place);
    }
    KOKKOS_FORCEINLINE_FUNCTION int below() const { return static_cast<int>(sums_ >> 24); }
    KOKKOS_FORCEINLINE_FUNCTION int count() const { return static_cast<int>(sums_ >> 16 & 255); }
    KOKKOS_FORCEINLINE_FUNCTION int thirds() const { return static_cast<int>(sums_ >> 8 & 255); }
    KOKKOS_FORCEINLINE_FUNCTION int places() const { return static_cast<int>(sums_ & 255); }

   private:
    /// Two tetrahedra let no sum outgrow its byte. With more, carries make the count higher, never less than three: 128
    /// tetrahedra carry less than 128 times.
    std::uint32_t sums_;
  };

  /// A tetrahedron of the star by the ranks of its other vertices, descending, and its place in VT.
  KOKKOS_FORCEINLINE_FUNCTION static Bytes wedge_of(int x, int y, int z, int place) {
    const int low = x < y ? x : y, high = x < y ? y : x;
    const int a = high > z ? high : z, c = low < z ? low : z;
    return Bytes(a, x ^ y ^ z ^ a ^ c, c, place);
  }

  KOKKOS_FORCEINLINE_FUNCTION void find_wedges(const std::uint8_t* ranks, const std::uint8_t* places, int star) {
    int count = 0;
    for (int t = 0; t < star; ++t) {
      const Bytes wedge = wedge_of(ranks[places[3 * t]], ranks[places[3 * t + 1]], ranks[places[3 * t + 2]], t);
      wedge_[count] = wedge;
      count += wedge[1] != none;
    }
    wedges_ = count;
  }

  /// Numbers the triangles of the wedges in the order of their keys. False if there are too many.
  KOKKOS_FORCEINLINE_FUNCTION bool number_triangles() {
    for (int a = 0; a < edges_; ++a) triangles_end_[a] = 0;
    for (int a = 0; a < max_edges && a < edges_ + below_in_word; ++a) below_[a] = 0;
    for (int i = 0; i < wedges_; ++i) {
      const Bytes w = wedge_[i];
      const Below bit_b = static_cast<Below>(Below(1) << (w[1] % below_bits)),
                  bit_c = static_cast<Below>(Below(1) << (w[2] % below_bits));
      below_[w[1]] |= bit_c;
      below_[w[0]] |= bit_b | bit_c;
    }
    int count = 0;
    for (int first = 0; first < edges_; first += below_in_word) {
      std::uint64_t rest = 0;
      for (int i = 0; i < below_in_word; ++i) rest |= std::uint64_t(below_[first + i]) << (i * below_bits % 64);
      for (; rest != 0; rest &= rest - 1) {
        const int bit = lowest_bit(rest), a = first + bit / below_bits, b = bit % below_bits;
        if (count == max_triangles) return false;
        triangle_[count] = Bytes(a, b, 0);
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
      const Bytes w = wedge_[i];
      const int a = w[0], b = w[1], c = w[2], place = w[3];
      const int ab = triangle_at_[a][b], ac = triangle_at_[a][c], bc = triangle_at_[b][c];
      cofaces_[bc].add(a, place, 0);
      cofaces_[ab].add(c, place, 1);
      cofaces_[ac].add(b, place, 0);
      tetrahedron_[count] = Bytes(ab, ac, bc, place);
      count += a != none;
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
      const Bytes triangle = triangle_[i];
      triangle_[i] = Bytes(triangle[0], triangle[1], triangle[0] + 1 + i + before);
      before += cofaces_[i].below();
      tetrahedra_end_[i + 1] = static_cast<std::uint8_t>(before);
    }
    tetrahedra_end_[0] = 0;
    int triangles = 0;
    for (int a = 0; a < edges_; ++a) {
      const int cell = a + triangles + tetrahedra_end_[triangles];
      edge_cell_[a] = static_cast<std::uint8_t>(cell);
      all_edges_.add(cell);
      cell_[cell] = Bytes(a, none, none);
      incidences_.add_edge(cell, a);
      triangles = triangles_end_[a] > triangles ? triangles_end_[a] : triangles;
    }
  }

  KOKKOS_FORCEINLINE_FUNCTION void connect_triangles() {
    for (int i = 0; i < triangles_; ++i) {
      const Bytes triangle = triangle_[i];
      const int a = triangle[0], b = triangle[1], cell = triangle[2];
      cell_[cell] = Bytes(a, b, none);
      incidences_.add_triangle(cell, a, edge_cell_[a], b, edge_cell_[b]);
    }
  }

  KOKKOS_FORCEINLINE_FUNCTION void connect_tetrahedra() {
    for (int i = 0; i < tetrahedra_; ++i) {
      const Bytes t = tetrahedron_[i], first = triangle_[t[0]], second = triangle_[t[1]];
      const int ab = first[2], ac = second[2], bc = triangle_[t[2]][2], c = second[1];
      const Cofaces cofaces = cofaces_[t[0]];
      // The other tetrahedron of (a, b) comes before if its third vertex is lower.
      const int cell = ab + 1 + (cofaces.count() == 2 && cofaces.thirds() - c < c);
      cell_[cell] = Bytes(first[0], first[1], c, t[3]);
      incidences_.add_tetrahedron(cell, ab, ac, bc);
    }
  }

  int edges_, triangles_, tetrahedra_, wedges_, cells_;
  Cells all_edges_;
  Incidences incidences_;
  Bytes cell_[Cells::capacity];  ///< ranks of the other vertices, `none` where there are fewer than three; place in VT
  Below below_[none + 1];
  std::uint8_t triangle_at_[none + 1][max_edges];
  std::uint8_t edge_cell_[max_edges];
  std::uint8_t triangles_end_[max_edges];  ///< one past the last triangle (a, b) of each a; 0 where it has none
  std::uint8_t tetrahedra_end_[max_triangles + 1];  ///< how many tetrahedra begin with a triangle before this
  Bytes triangle_[max_triangles];                   ///< ranks a and b, its cell
  Cofaces cofaces_[max_triangles + 1];
  Bytes tetrahedron_[max_star + 1];  ///< its triangles (a, b), (a, c), (b, c), its place in VT
  Bytes wedge_[max_star + 1];  ///< cells of the star with two lower vertices or more, see wedge_of; a may be `none`
};

}  // namespace gale::detail
