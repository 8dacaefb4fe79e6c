#pragma once

#include <gale/base/team.hpp>
#include <gale/base/types.hpp>

namespace gale {

/// What a kernel needs in scratch memory for one segment, in entries. Row kernels need `rows` alone.
struct StarSizes {
  Id rows = 0;        ///< of the segment: its vertices, for star kernels
  Id star = 0;        ///< entries of all its VT rows
  Id neighbours = 0;  ///< entries of all its VV rows
  Id slots = 0;  ///< hash slots for the neighbours of one vertex; a power of two, enough if three times its tetrahedra
  Id cells = 0;  ///< that touch it
  Id outside = 0;  ///< vertices of theirs that other segments hold

  KOKKOS_FUNCTION bool contains(const StarSizes& other) const {
    return rows >= other.rows && star >= other.star && neighbours >= other.neighbours && slots >= other.slots &&
           cells >= other.cells && outside >= other.outside;
  }
};

/// The greater of each.
inline StarSizes larger(const StarSizes& a, const StarSizes& b) {
  const auto greater = [](Id x, Id y) { return x < y ? y : x; };
  return {greater(a.rows, b.rows),   greater(a.star, b.star),   greater(a.neighbours, b.neighbours),
          greater(a.slots, b.slots), greater(a.cells, b.cells), greater(a.outside, b.outside)};
}

/// Where a kernel leaves the blocks of a batch: one stretch of memory, in which a team reserves its exact space with an
/// atomic. A block begins at a multiple of four words. Trivially copyable; owns nothing.
struct BlockPool {
  static constexpr Offset missing = -1;
  static constexpr Offset uncountable =
      -2;  ///< in the directory: the segment's rows have more entries than an Id counts

  Id* words = nullptr;
  Offset capacity = 0;     ///< words
  Offset* used = nullptr;  ///< words reserved; above `capacity` it says what the batch would have needed
  Offset* directory =
      nullptr;  ///< where the block of each segment of the batch and each relation wanted begins, or `missing`
  StarSizes* needed =
      nullptr;  ///< raised to what a segment whose blocks are missing would have needed in scratch memory

  /// What a block of `count` words takes.
  KOKKOS_FUNCTION static Offset rounded(Offset count) { return (count + 3) / 4 * 4; }

  /// Where a block of `count` words begins, or `missing` if it doesn't fit. By one lane of a team.
  template <class Team>
  KOKKOS_FUNCTION Offset reserve(const Team& team, Offset count) const {
    const Offset begin = team::add(team, used, rounded(count));
    return begin + count <= capacity ? begin : missing;
  }

  /// Records what a segment would have needed. By one lane of a team.
  template <class Team>
  KOKKOS_FUNCTION void need(const Team& team, const StarSizes& sizes) const {
    team::raise(team, &needed->rows, sizes.rows);
    team::raise(team, &needed->star, sizes.star);
    team::raise(team, &needed->neighbours, sizes.neighbours);
    team::raise(team, &needed->slots, sizes.slots);
    team::raise(team, &needed->cells, sizes.cells);
    team::raise(team, &needed->outside, sizes.outside);
  }
};

}  // namespace gale
