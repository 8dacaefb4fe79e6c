#pragma once

#include <cassert>
#include <cstdint>

#include <gale/base/kokkos.hpp>
#include <gale/base/types.hpp>

// Blocks as their readers see them. Nothing here owns memory: a row is valid as long as the block it lies in.

namespace gale {

/// One row of a relation: GALE's ids, ascending.
struct Row {
  const Id* ids = nullptr;  ///< the entries
  Id count = 0;             ///< how many there are

  /// How many entries there are.
  KOKKOS_FUNCTION Id size() const { return count; }

  /// The i-th entry, counted from 0. Nothing is checked.
  KOKKOS_FUNCTION Id operator[](Id i) const { return ids[i]; }

  /// The first entry.
  KOKKOS_FUNCTION const Id* begin() const { return ids; }

  /// One past the last entry.
  KOKKOS_FUNCTION const Id* end() const { return ids + count; }
};

/// The rows of `count` consecutive simplices, from `first` on. The row of simplex first + i is ids[offsets[i]] to
/// ids[offsets[i + 1] - 1]; offsets needn't begin with 0.
struct Rows {
  Id first = 0;                 ///< the first simplex
  Id count = 0;                 ///< how many rows there are
  const Id* offsets = nullptr;  ///< count + 1 of them
  const Id* ids = nullptr;      ///< the entries of all rows

  /// The row of a simplex, which must be one of these: an assertion where NDEBUG is not defined, undefined otherwise.
  KOKKOS_FUNCTION Row operator[](Id simplex) const {
    const Id i = simplex - first;
    assert(i >= 0 && i < count && "these rows are of other simplices");
    return {ids + offsets[i], offsets[i + 1] - offsets[i]};
  }
};

/// The link of a vertex: for each tetrahedron of its star, the places of the other three vertices in its VV row, in 1,
/// 2 or 4 bytes each.
struct LinkRow {
  const void* places = nullptr;  ///< three for each tetrahedron
  Id count = 0;                  ///< tetrahedra
  int width = 1;                 ///< bytes of a place

  /// How many tetrahedra there are.
  KOKKOS_FUNCTION Id size() const { return count; }

  /// Place of the corner 0..2 of the i-th tetrahedron. The three are in the order of the vertices' ids, hence ascend.
  KOKKOS_FUNCTION Id operator()(Id i, int corner) const {
    const Id at = 3 * i + corner;
    if (width == 1) return static_cast<const std::uint8_t*>(places)[at];
    if (width == 2) return static_cast<const std::uint16_t*>(places)[at];
    return static_cast<const Id*>(places)[at];
  }
};

/// The link rows of `count` consecutive vertices. `offsets` count tetrahedra, as those of VT do.
struct LinkRows {
  Id first = 0;                  ///< the first vertex
  Id count = 0;                  ///< how many rows there are
  const Id* offsets = nullptr;   ///< count + 1 of them
  const void* places = nullptr;  ///< the places of all rows
  int width = 1;                 ///< bytes of a place

  /// The link of a vertex, which must be one of these: an assertion where NDEBUG is not defined, undefined otherwise.
  KOKKOS_FUNCTION LinkRow operator[](Id vertex) const {
    const Id i = vertex - first;
    assert(i >= 0 && i < count && "these links are of other vertices");
    const auto* const bytes = static_cast<const std::uint8_t*>(places);
    return {bytes + static_cast<Offset>(3) * width * offsets[i], offsets[i + 1] - offsets[i], width};
  }
};

/// A vertex and what touches it: its rows of VV and VT, and its link.
struct VertexStar {
  Id vertex = no_id;  ///< the vertex itself
  Row neighbours;     ///< its row of VV
  Row tetrahedra;     ///< its row of VT
  LinkRow link;       ///< its link
};

/// Bytes that a place in rows of at most `longest` entries takes.
KOKKOS_INLINE_FUNCTION int width_for(Id longest) { return longest <= 256 ? 1 : longest <= 65536 ? 2 : 4; }

/// How blocks lie in memory, in words of an Id: the offsets of `rows` rows and one more, then the ids; in a block of
/// links, the width of a place stands between, and the places follow it.
struct BlockLayout {
  Id first = 0;  ///< the first simplex
  Id rows = 0;   ///< how many rows there are

  /// Words of a block of so many rows that have so many entries together.
  KOKKOS_FUNCTION static Offset words(Id rows, Offset entries) { return rows + 1 + entries; }

  /// Words of a block of links of so many vertices that have so many tetrahedra together.
  KOKKOS_FUNCTION static Offset link_words(Id rows, Offset tetrahedra, int width) {
    return rows + 2 + (3 * tetrahedra * width + Offset(sizeof(Id)) - 1) / Offset(sizeof(Id));
  }

  /// The rows in a block.
  KOKKOS_FUNCTION Rows rows_in(const Id* block) const { return {first, rows, block, block + rows + 1}; }

  /// The links in a block of links.
  KOKKOS_FUNCTION LinkRows links_in(const Id* block) const {
    return {first, rows, block, block + rows + 2, block[rows + 1]};
  }
};

}  // namespace gale
