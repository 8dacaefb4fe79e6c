#pragma once

#include <cstdint>

#include <gale/base/bits.hpp>
#include <gale/mesh/grid/grid_view.hpp>

// The stars of a grid's vertices. Which of the eight cubes around a vertex are there says all about its star but the
// numbers: that is its kind. Cube i of the eight lies at x - 1 where i is even, else at x; at y - 1 and z - 1 in the
// rows 0, at z - 1 in 1, at y - 1 in 2, and in the vertex's own in 3, which is i / 2. So they ascend. Of squares only
// the last four are there.
//
// Neighbours lie in 14 directions, in the order of their ids: -xyz, -yz, -xz, -z, -xy, -y, -x, and back from x to xyz.
// Direction d leads to a row of its own, d / 2.

namespace gale::detail {

inline constexpr int grid_directions = 14;  ///< of neighbours
inline constexpr int grid_star = 24;        ///< cells of a vertex of which all eight cubes are there
inline constexpr int grid_kinds = 256;      ///< of stars

/// What all stars of a kind have in common. Places are those in rows of VV, and of VT or VF.
struct StarKind {
  std::uint16_t directions;                 ///< of neighbours: a bit each
  std::uint8_t neighbours;                  ///< how many these are
  std::uint8_t cells;                       ///< how many there are
  std::uint8_t is_open;                     ///< whether a facet at the vertex has one cell alone
  std::uint8_t direction[grid_directions];  ///< of each neighbour
  std::uint8_t cell[grid_star];             ///< of each, 8 times its number in the cube and the cube's 0 to 7
  std::uint8_t link[3 * grid_star];         ///< of each cell, the places of its other vertices
  std::uint16_t touching[grid_directions];  ///< by direction: those of which a neighbour shares an edge of the link

  /// Connected components of some of the neighbours, given by their directions.
  KOKKOS_INLINE_FUNCTION int components(std::uint32_t rest) const {
    int count = 0;
    for (; rest != 0; ++count) {
      std::uint32_t front = rest & (~rest + 1);
      rest &= ~front;
      while (front != 0) {
        const std::uint32_t met = touching[lowest_bit(front)] & rest;
        front = (front & (front - 1)) | met;
        rest &= ~met;
      }
    }
    return count;
  }
};

/// Goes from vertex to vertex of a grid, at the least cost where the next one is the next in its row, and says what is
/// around it.
class GridCursor {
 public:
  KOKKOS_FORCEINLINE_FUNCTION explicit GridCursor(const GridView& grid) : grid_(grid) {}

  /// Goes to a vertex, which must be there.
  KOKKOS_FORCEINLINE_FUNCTION void go_to(Id vertex) {
    if (vertex != vertex_ + 1 || !step()) seek(vertex);
  }

  KOKKOS_FORCEINLINE_FUNCTION Id vertex() const { return vertex_; }

  /// Which of the eight cubes around it are there: a bit each.
  KOKKOS_FORCEINLINE_FUNCTION int kind() const { return kind_; }

  /// Its neighbour in a direction, which must be there.
  KOKKOS_FORCEINLINE_FUNCTION Id neighbour(int direction) const {
    const int row = direction >> 1;
    return row == 3 ? vertex_ + 2 * (direction & 1) - 1 : rows_[row] + (direction & 1) - (row < 3 ? 1 : 0);
  }

  /// A cell of it, as its kind tells it.
  KOKKOS_FORCEINLINE_FUNCTION Id cell(int of_kind) const {
    const int cube = of_kind & 7;
    return (cubes_[cube >> 1] + (cube & 1) - 1) * grid_.cells_per_cube() + (of_kind >> 3);
  }

 private:
  static constexpr int at_lower_x = 0x55, at_x = 0xaa;  ///< the cubes at x - 1 and at x

  KOKKOS_INLINE_FUNCTION void seek(Id vertex) {
    const GridPlace at = grid_.place_of_vertex(vertex);
    vertex_ = vertex;
    x_ = at.x;
    grid_.is_whole() ? seek_in_whole(at) : seek_in_bits(at);
  }

  KOKKOS_INLINE_FUNCTION void seek_in_whole(const GridPlace& at) {
    const bool is_plane = grid_.dimension == 2;
    const Id row = grid_.nx, layer = is_plane ? 0 : row * grid_.ny;
    const Id cubes = row - 1, cube_layer = is_plane ? 0 : cubes * (grid_.ny - 1);
    rows_[0] = vertex_ - layer - row;
    rows_[1] = vertex_ - layer;
    rows_[2] = vertex_ - row;
    rows_[4] = vertex_ + row;
    rows_[5] = vertex_ + layer;
    rows_[6] = vertex_ + layer + row;
    cubes_[3] = (at.z * (grid_.ny - 1) + at.y) * cubes + at.x;
    cubes_[2] = cubes_[3] - cubes;
    cubes_[1] = cubes_[3] - cube_layer;
    cubes_[0] = cubes_[1] - cubes;
    const int lower_y = at.y > 0 ? 0x33 : 0, own_y = at.y < grid_.ny - 1 ? 0xcc : 0;
    const int lower_z = at.z > 0 ? 0x0f : 0, own_z = is_plane || at.z < grid_.nz - 1 ? 0xf0 : 0;
    in_rows_ = (lower_y | own_y) & (lower_z | own_z);
    kind_ = in_rows_ & around_x();
  }

  KOKKOS_FORCEINLINE_FUNCTION int around_x() const {
    return (x_ > 0 ? at_lower_x : 0) | (x_ < grid_.nx - 1 ? at_x : 0);
  }

  KOKKOS_INLINE_FUNCTION void seek_in_bits(const GridPlace& at) {
    const Id row = at.y + grid_.ny * at.z;
    const Id to[7] = {row - grid_.ny - 1, row - grid_.ny, row - 1, row, row + 1, row + grid_.ny, row + grid_.ny + 1};
    kind_ = 0;
    for (int i = 0; i < 7; ++i) {
      // The row behind the last is empty: it stands for all that aren't there.
      begin_[i] = grid_.row * (to[i] < 0 || to[i] >= grid_.rows() ? grid_.rows() : to[i]);
      if (i != 3) rows_[i] = grid_.vertices.rank(begin_[i] + x_);
    }
    for (int i = 0; i < 4; ++i) {
      cubes_[i] = grid_.cubes.rank(begin_[i] + x_);
      if (x_ > 0) kind_ |= int(grid_.cubes.has(begin_[i] + x_ - 1)) << (2 * i);
      kind_ |= int(grid_.cubes.has(begin_[i] + x_)) << (2 * i + 1);
    }
  }

  /// Goes to the next vertex if it is at x + 1; else does nothing, and returns false.
  KOKKOS_FORCEINLINE_FUNCTION bool step() {
    if (x_ < 0 || x_ + 1 >= grid_.nx) return false;
    if (grid_.is_whole()) {
      for (int i = 0; i < 7; ++i) ++rows_[i];
      for (int i = 0; i < 4; ++i) ++cubes_[i];
      ++x_;
      kind_ = in_rows_ & around_x();
    } else {
      if (!grid_.vertices.has(begin_[3] + x_ + 1)) return false;
      for (int i = 0; i < 7; ++i) rows_[i] += grid_.vertices.has(begin_[i] + x_);
      int ahead = 0;
      for (int i = 0; i < 4; ++i) {
        cubes_[i] += kind_ >> (2 * i + 1) & 1;
        ahead |= int(grid_.cubes.has(begin_[i] + x_ + 1)) << (2 * i + 1);
      }
      ++x_;
      kind_ = (kind_ >> 1 & at_lower_x) | ahead;
    }
    ++vertex_;
    return true;
  }

  const GridView grid_;
  Id vertex_ = no_id, x_ = no_id;
  int kind_ = 0;
  int in_rows_ = 0;       ///< of a whole grid: the cubes whose rows are there
  Id rows_[7] = {};       ///< the first vertex at x or after it, in each row that neighbours lie in
  Id cubes_[4] = {};      ///< the first cube likewise, in each row of cubes
  Offset begin_[7] = {};  ///< of a grid that isn't whole: where these rows begin among the bits
};

}  // namespace gale::detail
