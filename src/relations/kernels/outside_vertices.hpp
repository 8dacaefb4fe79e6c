#pragma once

#include <gale/base/bits.hpp>
#include <gale/mesh/quad.hpp>
#include <gale/relations/kernels/bit_star_scratch.hpp>

namespace gale::detail {

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
