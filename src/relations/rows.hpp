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

/// The link of a vertex: for each cell of its star, the places of the other vertices in its VV row, in 1, 2 or 4 bytes
/// each.
struct LinkRow {
  const void* places = nullptr;  ///< the cells', one after the other
  Id count = 0;                  ///< cells
  int width = 1;                 ///< bytes of a place
  int others = 3;                ///< places of a cell: three of a tetrahedron, two of a triangle

  /// How many cells there are.
  KOKKOS_FUNCTION Id size() const { return count; }

  /// Place of one of the i-th cell's other vertices, counted from 0. They are in the order of the vertices' ids, hence
  /// ascend.
  KOKKOS_FUNCTION Id operator()(Id i, int corner) const { return place(others * i + corner); }

  /// What that is where a cell is known to have so many.
  template <int known>
  KOKKOS_FORCEINLINE_FUNCTION Id of(Id i, int corner) const {
    return place(known * i + corner);
  }

 private:
  KOKKOS_FORCEINLINE_FUNCTION Id place(Id at) const {
    if (width == 1) return static_cast<const std::uint8_t*>(places)[at];
    if (width == 2) return static_cast<const std::uint16_t*>(places)[at];
    return static_cast<const Id*>(places)[at];
  }
};

/// The link rows of `count` consecutive vertices. `offsets` count cells, as those of VT do.
struct LinkRows {
  Id first = 0;                  ///< the first vertex
  Id count = 0;                  ///< how many rows there are
  const Id* offsets = nullptr;   ///< count + 1 of them
  const void* places = nullptr;  ///< the places of all rows
  int width = 1;                 ///< bytes of a place
  int others = 3;                ///< places of a cell

  /// The link of a vertex, which must be one of these: an assertion where NDEBUG is not defined, undefined otherwise.
  KOKKOS_FUNCTION LinkRow operator[](Id vertex) const {
    const Id i = vertex - first;
    assert(i >= 0 && i < count && "these links are of other vertices");
    const auto* const bytes = static_cast<const std::uint8_t*>(places);
    return {bytes + static_cast<Offset>(others) * width * offsets[i], offsets[i + 1] - offsets[i], width, others};
  }
};

/// A vertex and what touches it: its rows of VV and VT (VF on triangle meshes), and its link.
struct VertexStar {
  Id vertex = no_id;  ///< the vertex itself
  Row neighbours;     ///< its row of VV
  Row cells;          ///< its row of VT or VF
  LinkRow link;       ///< its link
};

/// Bytes that a place in rows of at most `longest` entries takes.
KOKKOS_INLINE_FUNCTION int width_for(Id longest) { return longest <= 256 ? 1 : longest <= 65536 ? 2 : 4; }

/// How blocks lie in memory, in words of an Id: the offsets of `rows` rows and one more, then the ids; in a block of
/// links, what says how places lie (`link_head`) stands between, and the places follow it.
struct BlockLayout {
  Id first = 0;  ///< the first simplex
  Id rows = 0;   ///< how many rows there are

  /// Words of a block of so many rows that have so many entries together.
  KOKKOS_FUNCTION static Offset words(Id rows, Offset entries) { return rows + 1 + entries; }

  /// Words of a block of links of so many vertices that have so many cells together, of so many other vertices each.
  KOKKOS_FUNCTION static Offset link_words(Id rows, Offset cells, int width, int others = 3) {
    return rows + 2 + (others * cells * width + Offset(sizeof(Id)) - 1) / Offset(sizeof(Id));
  }

  /// The word that says how many bytes a place takes, and how many places a cell.
  KOKKOS_FUNCTION static Id link_head(int width, int others) { return others << 8 | width; }

  /// The rows in a block.
  KOKKOS_FUNCTION Rows rows_in(const Id* block) const { return {first, rows, block, block + rows + 1}; }

  /// The links in a block of links.
  KOKKOS_FUNCTION LinkRows links_in(const Id* block) const {
    return {first, rows, block, block + rows + 2, block[rows + 1] & 255, block[rows + 1] >> 8};
  }
};

}  // namespace gale
