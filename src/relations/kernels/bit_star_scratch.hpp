#pragma once

#include <cstdint>

#include <gale/base/bits.hpp>
#include <gale/mesh/encoded_mesh.hpp>
#include <gale/relations/kernels/star_request.hpp>

namespace gale::detail {

/// What the four vertices of a tetrahedron are called within a segment.
struct alignas(8) CornerNumbers {
  std::uint16_t of[4];
};

/// What a lane reads at once.
struct alignas(16) FourIds {
  Id of[4];
};

/// The scratch memory of a team that goes the way of BitStars, divided. Matrices of bits have a column for each vertex
/// of the segment and lie word after word, so that lanes which go down a column each never meet in a bank. What is
/// needed at different times shares a place.
struct BitStarScratch {
  StarShared* shared;
  Id* star_begin;  ///< rows + 1
  Id* degree;      ///< rows + 1: neighbours of each vertex, later where its VV row begins

  std::uint32_t* star_bits;   ///< column of a vertex: the tetrahedra of its star, as SegmentTetrahedra counts them
  std::uint16_t* neighbours;  ///< numbers, row after row; in the place of star_bits

  std::uint16_t* star;     ///< tetrahedra as star_bits counts them, row after row; for links 4 * tetrahedron + corner
  Id* keys;                ///< in the place of `star`: hash slots for the vertices outside, later their numbers
  FourIds* list;           ///< there too: those vertices as they came
  std::uint16_t* slot_of;  ///< and their slots

  Id* outside;                    ///< the vertices outside, ascending
  CornerNumbers* corners;         ///< of each tetrahedron
  std::uint32_t* neighbour_bits;  ///< column of a vertex: the numbers of its neighbours
  std::uint16_t* before;          ///< how many bits are set above each word of neighbour_bits

  std::size_t bytes;

  KOKKOS_FORCEINLINE_FUNCTION BitStarScratch(char* memory, const StarSizes& sizes) {
    std::size_t end = 0;
    const auto place = [memory](std::size_t& at, std::size_t count, auto*& array) {
      using Entry = std::remove_reference_t<decltype(*array)>;
      if (memory != nullptr) array = reinterpret_cast<Entry*>(memory + at);
      at += (count * sizeof(Entry) + 15) / 16 * 16;
    };
    const std::size_t rows = sizes.rows, outside = sizes.outside, tetrahedra = outside > 0 ? sizes.cells : 0;
    place(end, 1, shared);
    place(end, rows + 1, star_begin);
    place(end, rows + 1, degree);

    std::size_t end_of_bits = end, end_of_neighbours = end;
    place(end_of_bits, words(sizes.cells) * rows, star_bits);
    place(end_of_neighbours, outside > 0 ? sizes.neighbours : 0, neighbours);
    end = end_of_bits > end_of_neighbours ? end_of_bits : end_of_neighbours;

    std::size_t end_of_star = end;
    place(end_of_star, sizes.star, star);
    place(end, slots(sizes), keys);
    place(end, (outside + 3) / 4, list);
    place(end, outside, slot_of);
    if (end < end_of_star) end = end_of_star;

    place(end, outside, this->outside);
    place(end, tetrahedra, corners);
    const std::size_t matrix = outside > 0 ? words(sizes.rows + sizes.outside) * rows : 0;
    place(end, matrix, neighbour_bits);
    place(end, matrix, before);
    bytes = end;
  }

  /// Words of 32 bits each.
  KOKKOS_FORCEINLINE_FUNCTION static std::size_t words(std::size_t bits) { return (bits + 31) / 32; }

  /// Hash slots, a power of two, for that many vertices outside. None where no neighbours are gathered.
  KOKKOS_FORCEINLINE_FUNCTION static std::size_t slots(const StarSizes& sizes) {
    if (sizes.outside == 0) return 0;
    std::size_t slots = 8;
    while (2 * slots < 5 * std::size_t(sizes.outside)) slots *= 2;
    return slots;
  }
};

/// Numbers the vertices of a segment and those outside that its tetrahedra reach, in the order of their ids: a hash set
/// of the team's.
class OutsideVertices {
 public:
  KOKKOS_FORCEINLINE_FUNCTION OutsideVertices(const BitStarScratch& scratch, const StarSizes& sizes, Id first, Id rows)
      : scratch_(scratch),
        capacity_(sizes.outside),
        slots_(static_cast<Id>(BitStarScratch::slots(sizes))),
        first_(first),
        rows_(rows) {}

  template <class Team>
  KOKKOS_FORCEINLINE_FUNCTION void clear(const Team& team) const {
    team::for_all(team, slots_, [&](Id slot) { scratch_.keys[slot] = no_id; });
    team::for_all(team, (capacity_ + 3) / 4, [&](Id four) {
      scratch_.list[four] = {{after_all, after_all, after_all, after_all}};
    });
  }

  KOKKOS_FORCEINLINE_FUNCTION Id first_slot(Id vertex) const {
    return static_cast<Id>(
        (std::uint64_t(static_cast<std::uint32_t>(vertex) * 0x9E3779B1u) * static_cast<std::uint32_t>(slots_)) >> 32);
  }
  KOKKOS_FORCEINLINE_FUNCTION Id key(Id slot) const { return scratch_.keys[slot]; }

  /// Calls found(corner, slot) for the vertices at some corners, given as bits; by any lane. One loop over corners and
  /// probes, so that a warp waits for the lane that takes longest, not at each corner for the one that takes longest
  /// there. If slots are lacking, found.outside says that more are needed.
  template <class Team, class Found>
  KOKKOS_FORCEINLINE_FUNCTION void insert(const Team& team, const Quad& four, std::uint32_t corners,
                                          const Found& found) const {
    Id vertex = no_id, slot = 0, probes = 0;
    int corner = 0;
    for (bool next = true; corners != 0 && probes < slots_; ++probes) {
      if (next) {
        corner = lowest_bit(corners);
        vertex = four[corner];
        slot = first_slot(vertex);
        probes = 0;
      }
      Id key = scratch_.keys[slot];
      if (key == no_id) key = team::exchange_if(team, &scratch_.keys[slot], no_id, vertex);
      next = key == no_id || key == vertex;
      if (next) {
        found(corner, slot);
        corners &= corners - 1;
      } else {
        slot = (slot + 1) & (slots_ - 1);
      }
    }
    if (corners != 0) team::raise(team, &scratch_.shared->found.outside, 4 * capacity_ + 64);
  }

  // All below: after the team has met again, and only if slots sufficed.

  /// Lists and counts them. By all; the team must meet before they are read.
  template <class Team>
  KOKKOS_FORCEINLINE_FUNCTION void list(const Team& team) const {
    team::for_all(team, slots_, [&](Id slot) {
      const Id vertex = scratch_.keys[slot];
      if (vertex == no_id) return;
      const Id place = team::add(team, &scratch_.shared->found.outside, Id(1));
      if (place >= capacity_) return;
      scratch_.list[place / 4].of[place % 4] = vertex;
      scratch_.slot_of[place] = static_cast<std::uint16_t>(slot);
    });
  }

  KOKKOS_FORCEINLINE_FUNCTION bool fit() const { return scratch_.shared->found.outside <= capacity_; }

  /// Gives them their numbers. If they fit; by all; the team must meet before they are read.
  template <class Team>
  KOKKOS_FORCEINLINE_FUNCTION void rank(const Team& team) const {
    const Id count = scratch_.shared->found.outside;
    team::for_all(team, count + 1, [&](Id i) {
      if (i == count) {
        scratch_.shared->below = count_less(count, first_);
      } else {
        const Id vertex = scratch_.list[i / 4].of[i % 4];
        const Id place = count_less(count, vertex);
        scratch_.outside[place] = vertex;
        scratch_.keys[scratch_.slot_of[i]] = vertex < first_ ? place : place + rows_;
      }
    });
  }

  KOKKOS_FORCEINLINE_FUNCTION Id number_of_slot(Id slot) const { return scratch_.keys[slot]; }
  KOKKOS_FORCEINLINE_FUNCTION Id number_of_row(Id row) const { return scratch_.shared->below + row; }

  KOKKOS_FORCEINLINE_FUNCTION Id vertex(Id number) const {
    const Id row = number - scratch_.shared->below;
    return row < 0 ? scratch_.outside[number] : row < rows_ ? first_ + row : scratch_.outside[number - rows_];
  }

 private:
  static constexpr Id after_all = 0x7fffffff;

  KOKKOS_FORCEINLINE_FUNCTION Id count_less(Id count, Id than) const {
    Id less = 0;
    for (Id four = 0; 4 * four < count; ++four) {
      const FourIds ids = scratch_.list[four];
      for (const Id id : ids.of) less += id < than ? 1 : 0;
    }
    return less;
  }

  BitStarScratch scratch_;
  Id capacity_;
  Id slots_;
  Id first_;
  Id rows_;
};

}  // namespace gale::detail
