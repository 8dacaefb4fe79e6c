#pragma once

#include <cstdint>
#include <type_traits>

#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/gradient/incidences.hpp>
#include <gale/algorithms/gradient/lower_neighbours.hpp>
#include <gale/algorithms/gradient/pair_star.hpp>
#include <gale/base/bits.hpp>
#include <gale/mesh/grid/grid_stars.hpp>
#include <gale/runtime/sweep_options.hpp>

// Lower stars in grids of tetrahedra. All vertices whose eight cubes are there have the same star: what touches what is
// a table, and which of it is lower follows from the ranks of 14 neighbours.

namespace gale::detail {

/// That star. Triangles are numbered; tetrahedra by their places in VT. Neighbours are named by their directions.
struct WholeStar {
  static constexpr int edges = grid_directions, triangles = 36, no_triangle = 255;

  std::uint8_t triangle[edges][16];  ///< the triangle of two neighbours; no_triangle where they have none
  Bytes around[triangles];           ///< the two tetrahedra of a triangle: third neighbours, then places, in this order
  std::uint8_t of_kind[grid_star];   ///< the tetrahedra, as GridCursor takes them

  WholeStar() = default;

  /// From the kind of star with all cubes.
  explicit WholeStar(const StarKind& kind);
};

/// What is around a vertex of such a star, computed as it is asked for: a VertexStar.
struct GridVertexStar {
  struct Neighbours {
    const GridCursor& at;
    KOKKOS_FORCEINLINE_FUNCTION Id operator[](Id direction) const { return at.neighbour(direction); }
  };
  struct Tetrahedra {
    const GridCursor& at;
    const WholeStar& whole;
    KOKKOS_FORCEINLINE_FUNCTION Id operator[](Id place) const { return at.cell(whole.of_kind[place]); }
  };

  Id vertex;
  Neighbours neighbours;
  Tetrahedra cells;
};

/// Which of its neighbours are lower, as LowerNeighbours says it.
class GridLowerNeighbours {
 public:
  static constexpr int upper = 15;  ///< the rank of one that isn't

  KOKKOS_FORCEINLINE_FUNCTION GridLowerNeighbours(const std::uint64_t* keys, const GridCursor& at) {
    const std::uint64_t key = keys[at.vertex()];
    std::uint64_t lower[grid_directions + 1];
    for (int d = 0; d < grid_directions; ++d) {
      const std::uint64_t other = keys[at.neighbour(d)];
      lower[count_] = other;
      direction_[count_] = static_cast<std::uint8_t>(d);
      count_ += other < key;
    }
    const std::uint64_t ranks = ranks_of_few(lower, count_);
    for (int i = 0; i < count_; ++i) {
      const std::uint64_t rank = ranks >> 4 * i & 15;
      by_rank_[rank] = static_cast<std::uint8_t>(i);
      ranks_ ^= (rank ^ upper) << 4 * direction_[i];
    }
  }

  KOKKOS_FORCEINLINE_FUNCTION int count() const { return count_; }
  KOKKOS_FORCEINLINE_FUNCTION Id place(int i) const { return direction_[i]; }
  KOKKOS_FORCEINLINE_FUNCTION int with_rank(int rank) const { return by_rank_[rank]; }

  /// The rank of the neighbour in a direction, or `upper`.
  KOKKOS_FORCEINLINE_FUNCTION int rank(int direction) const { return static_cast<int>(ranks_ >> 4 * direction & 15); }

 private:
  int count_ = 0;
  std::uint64_t ranks_ = ~std::uint64_t(0);      ///< by direction, four bits each
  std::uint8_t direction_[grid_directions + 1];  ///< of each, ascending
  std::uint8_t by_rank_[grid_directions + 1];
};

/// What LowerStar is, of such a star: one of at most 64 cells but the vertex.
template <bool is_small>
class GridLowerStar {
 public:
  using Cells = CellSet<1>;

  static constexpr std::uint8_t none = LowerNeighbours::none;
  static constexpr bool may_fork = false, may_leave = false;
  static constexpr int no_place = -1;

  /// False if it has more cells.
  KOKKOS_FORCEINLINE_FUNCTION bool build(const GridLowerNeighbours& lower, const WholeStar& whole) {
    whole_ = &whole;
    if (lower.count() == grid_directions) return false;
    std::uint8_t cell_of[WholeStar::triangles];
    std::uint8_t edge_cell[grid_directions];
    int count = 0;
    all_edges_ = Cells::none();
    for (int a = 0; a < lower.count(); ++a) {
      const std::uint8_t* const triangles = whole.triangle[lower.place(lower.with_rank(a))];
      edge_cell[a] = static_cast<std::uint8_t>(count);
      all_edges_.add(count);
      cell_[count] = Bytes(a, none, none);
      incidences_.add_edge(count++, a);
      Bytes with[grid_directions];
      int found = 0;
      for (int b = 0; b < a; ++b) {
        const int triangle = triangles[lower.place(lower.with_rank(b))];
        with[found] = Bytes(b, triangle, 0);
        found += triangle != WholeStar::no_triangle;
      }
      for (int i = 0; i < found; ++i) {
        const int b = with[i][0], triangle = with[i][1], ab = count++;
        if (ab == Cells::capacity) return false;
        cell_of[triangle] = static_cast<std::uint8_t>(ab);
        cell_[ab] = Bytes(a, b, none, triangle);
        incidences_.add_triangle(ab, a, edge_cell[a], b, edge_cell[b]);
        const Bytes around = whole.around[triangle];
        const int one = lower.rank(around[0]), other = lower.rank(around[1]);
        const bool is_first = one < other;
        const auto add = [&](int third, int c, int place) {
          if (c >= b) return true;
          if (count == Cells::capacity) return false;
          cell_[count] = Bytes(a, b, c, place);
          const std::uint8_t* const below = whole.triangle[lower.place(lower.with_rank(b))];
          incidences_.add_tetrahedron(count++, ab, cell_of[triangles[third]], cell_of[below[third]]);
          return true;
        };
        if (!add(around[is_first ? 0 : 1], is_first ? one : other, around[is_first ? 2 : 3])) return false;
        if (!add(around[is_first ? 1 : 0], is_first ? other : one, around[is_first ? 3 : 2])) return false;
      }
      if (count == Cells::capacity && a + 1 < lower.count()) return false;
    }
    return true;
  }

  KOKKOS_FORCEINLINE_FUNCTION const Cells& all_edges() const { return all_edges_; }
  KOKKOS_FORCEINLINE_FUNCTION Cells facets(int cell) const { return incidences_.facets(cell); }
  KOKKOS_FORCEINLINE_FUNCTION Cells cofacets(int cell) const { return incidences_.cofacets(cell); }
  KOKKOS_FORCEINLINE_FUNCTION Bytes corners(int cell) const { return cell_[cell]; }
  KOKKOS_FORCEINLINE_FUNCTION int place(int tetrahedron) const { return cell_[tetrahedron][3]; }
  KOKKOS_FORCEINLINE_FUNCTION int dimension(int cell) const {
    const Bytes all = corners(cell);
    return all[1] == none ? 1 : all[2] == none ? 2 : 3;
  }
  KOKKOS_FORCEINLINE_FUNCTION int across(int triangle, int place) const {
    const Bytes around = whole_->around[cell_[triangle][3]];
    return around[2] + around[3] - place;
  }
  template <class Visit>
  KOKKOS_FORCEINLINE_FUNCTION void for_each_place(int triangle, const Visit& visit) const {
    const Bytes around = whole_->around[cell_[triangle][3]];
    visit(around[2]);
    visit(around[3]);
  }

 private:
  using Incidences = std::conditional_t<is_small, ByteIncidences<1, grid_directions>, SetIncidences<1>>;

  const WholeStar* whole_;
  Cells all_edges_;
  Incidences incidences_;
  Bytes cell_[Cells::capacity];  ///< ranks of the other vertices, descending; a triangle's number, or the place in VT
};

/// Pairs the lower star of the vertex that a cursor is at, all of whose cubes are there; false if it is too large.
GALE_CALLS_ANY
template <bool is_small, class Sink>
KOKKOS_FORCEINLINE_FUNCTION bool pair_on_grid(const Sink& sink, const WholeStar& whole, const std::uint64_t* keys,
                                              const GridCursor& at) {
  const GridLowerNeighbours lower(keys, at);
  GridLowerStar<is_small> cells;
  if (!cells.build(lower, whole)) return false;
  pair_star(sink, GridVertexStar{at.vertex(), {at}, {at, whole}}, lower, cells,
            BitQueues<GridLowerStar<is_small>>(cells));
  return true;
}

/// The rows of a vertex of any grid, for what reads stars.
struct GridStarRows {
  Id neighbours[grid_directions], cells[grid_star];

  KOKKOS_FORCEINLINE_FUNCTION VertexStar at(const GridCursor& at, const StarKind& kind, int dimension) {
    for (int i = 0; i < kind.neighbours; ++i) neighbours[i] = at.neighbour(kind.direction[i]);
    for (int i = 0; i < kind.cells; ++i) cells[i] = at.cell(kind.cell[i]);
    return {at.vertex(), {neighbours, kind.neighbours}, {cells, kind.cells}, {kind.link, kind.cells, 1, dimension}};
  }
};

/// Pairs all lower stars of a grid by threads of the host, without a structure.
void pair_all_on_grid(GradientStore& store, int consumers, const SweepOptions& options);

}  // namespace gale::detail
