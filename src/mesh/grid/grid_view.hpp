#pragma once

#include <cstdint>

#include <gale/base/bits.hpp>
#include <gale/base/types.hpp>
#include <gale/mesh/encoded_mesh.hpp>

// A regular grid as kernels see it: simplices are computed from places.

namespace gale {

/// A corner of a cube by its coordinates: bit 0 is x, bit 1 y, bit 2 z. Each of the six tetrahedra of a cube walks from
/// corner 0 to corner 7 along the axes in one of the orders xyz, xzy, yxz, yzx, zxy, zyx (Freudenthal).
inline constexpr int tetrahedra_per_cube = 6;
/// The corners of these tetrahedra.
inline constexpr std::uint8_t freudenthal[tetrahedra_per_cube][4] = {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7},
                                                                     {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}};

namespace detail {

/// A set of places that counts its members: bits in words of 64, and how many come before each word. Owns nothing.
struct RankedBits {
  const std::uint64_t* words = nullptr;  ///< a bit a place
  const Id* before = nullptr;            ///< members before each word, and of all
  const Id* word_of = nullptr;           ///< the words of members 0, 64, 128, ..., and the last word

  KOKKOS_FORCEINLINE_FUNCTION bool has(Offset place) const { return words[place >> 6] >> (place & 63) & 1; }

  /// How many members come before a place.
  KOKKOS_FORCEINLINE_FUNCTION Id rank(Offset place) const {
    const std::uint64_t below = (std::uint64_t(1) << (place & 63)) - 1;
    return before[place >> 6] + count_bits(words[place >> 6] & below);
  }

  /// The place of a member, counted from 0.
  KOKKOS_INLINE_FUNCTION Offset place(Id member) const {
    Id low = word_of[member >> 6], high = word_of[(member >> 6) + 1];
    while (low < high) {
      const Id middle = low + (high - low + 1) / 2;
      if (before[middle] <= member) {
        low = middle;
      } else {
        high = middle - 1;
      }
    }
    return Offset(low) * 64 + nth_bit(words[low], member - before[low]);
  }
};

/// A point of a grid, or a cube by its lowest corner.
struct GridPlace {
  Id x, y, z;
};

}  // namespace detail

/// A grid for code that runs where its arrays are; one of which all cubes are there has none. Vertices, cubes and cells
/// are numbered x fastest, z slowest, the cells of a cube one after the other. So the cells of a cube have its lowest
/// corner as their lowest vertex, and come in the lexicographic order of their vertices. Owns nothing.
struct GridView {
  Id nx = 0;          ///< points along x
  Id ny = 0;          ///< points along y
  Id nz = 0;          ///< points along z; 1 where cells are triangles
  Offset row = 0;     ///< places of a row along x in the bits; 0 where all cubes are there
  int dimension = 3;  ///< that of the cells

  detail::RankedBits vertices;  ///< points that a cube uses
  detail::RankedBits cubes;     ///< by their lowest corners

  /// Whether all cubes are there.
  KOKKOS_FORCEINLINE_FUNCTION bool is_whole() const { return row == 0; }

  /// How many cells a cube has, or a square.
  KOKKOS_FORCEINLINE_FUNCTION Id cells_per_cube() const { return dimension == 3 ? tetrahedra_per_cube : 2; }

  /// How many rows along x there are.
  KOKKOS_FORCEINLINE_FUNCTION Id rows() const { return ny * nz; }

  /// Where a vertex is.
  KOKKOS_INLINE_FUNCTION detail::GridPlace place_of_vertex(Id vertex) const {
    if (is_whole()) return {vertex % nx, vertex / nx % ny, vertex / nx / ny};
    return place_in_bits(vertices.place(vertex));
  }

  /// Where a cube is.
  KOKKOS_INLINE_FUNCTION detail::GridPlace place_of_cube(Id cube) const {
    if (is_whole()) return {cube % (nx - 1), cube / (nx - 1) % (ny - 1), cube / (nx - 1) / (ny - 1)};
    return place_in_bits(cubes.place(cube));
  }

  /// The first vertex at a point or after it.
  KOKKOS_INLINE_FUNCTION Id vertex_at(Id x, Id y, Id z) const {
    const Id of = y + ny * z;
    return is_whole() ? of * nx + x : vertices.rank(of * row + x);
  }

  /// How many cubes come before that of which a point is the lowest corner.
  KOKKOS_INLINE_FUNCTION Id cubes_before(Id x, Id y, Id z) const {
    if (!is_whole()) return cubes.rank((y + Offset(ny) * z) * row + x);
    if (dimension == 3 && z == nz - 1) return z * (ny - 1) * (nx - 1);
    return (z * (ny - 1) + y) * (nx - 1) + (y == ny - 1 ? 0 : x);
  }

  /// The first cell of which a vertex, or a later one, is the lowest.
  KOKKOS_INLINE_FUNCTION Id first_cell(Id vertex) const {
    const detail::GridPlace at = place_of_vertex(vertex);
    return cells_per_cube() * cubes_before(at.x, at.y, at.z);
  }

  /// The corners of a cube that have the lower x, by y and z.
  KOKKOS_INLINE_FUNCTION Quad corners_of_cube(Id cube) const {
    if (!is_whole() && dimension == 3) {
      const Offset place = cubes.place(cube), above = place + row * ny;
      return {vertices.rank(place), vertices.rank(place + row), vertices.rank(above), vertices.rank(above + row)};
    }
    const detail::GridPlace at = place_of_cube(cube);
    const Id lowest = vertex_at(at.x, at.y, at.z), beside = vertex_at(at.x, at.y + 1, at.z);
    if (dimension == 2) return {lowest, beside, no_id, no_id};
    return {lowest, beside, vertex_at(at.x, at.y, at.z + 1), vertex_at(at.x, at.y + 1, at.z + 1)};
  }

  /// The vertices of a cube's cell by its number there, ascending; of a triangle the third one twice.
  KOKKOS_INLINE_FUNCTION Quad cell_of_cube(const Quad& corners, int number) const {
    const auto [lowest, beside, above, across] = corners;
    if (dimension == 2) return {lowest, number == 0 ? lowest + 1 : beside, beside + 1, beside + 1};
    const Id second = number < 2 ? lowest + 1 : number < 4 ? beside : above;
    const Id third = (number & 5) == 0 ? beside + 1 : number == 1 || number == 4 ? above + 1 : across;
    return {lowest, second, third, across + 1};
  }

  /// The vertices of a cell, likewise.
  KOKKOS_INLINE_FUNCTION Quad cell(Id t) const {
    return cell_of_cube(corners_of_cube(t / cells_per_cube()), static_cast<int>(t % cells_per_cube()));
  }

 private:
  KOKKOS_FORCEINLINE_FUNCTION detail::GridPlace place_in_bits(Offset place) const {
    const Id of = static_cast<Id>(place / row);
    return {static_cast<Id>(place % row), of % ny, of / ny};
  }
};

}  // namespace gale
