#pragma once

#include <gale/base/team.hpp>
#include <gale/base/types.hpp>
#include <gale/relations/kernels/hashed_star_scratch.hpp>
#include <gale/relations/kernels/ranking.hpp>

namespace gale::detail {

/// The distinct neighbours of one vertex, gathered by a warp: a hash set in its scratch memory, open addressing.
template <class Team>
class NeighbourSet {
 public:
  /// For a vertex of `tetrahedra` tetrahedra, with at most `slots` slots. To be called by all lanes, inside for_warps.
  KOKKOS_FORCEINLINE_FUNCTION NeighbourSet(const Team& team, const HashedStarScratch& scratch, Id slots, Id tetrahedra)
      : team_(team),
        warp_(scratch.warp),
        keys_(scratch.keys),
        places_(scratch.places),
        list_(scratch.list),
        ranks_(scratch.ranks) {
    while ((Id(1) << bits_) < 3 * tetrahedra && (Id(1) << bits_) < slots) ++bits_;
    team::for_lanes(team_, Id(1) << bits_, [&](Id slot) { keys_[slot] = no_id; });
    team::once_per_warp(team_, [&] { warp_->count = warp_->overflow = 0; });
    team::warp_barrier(team_);
  }

  /// By any lane. On a team of one thread it returns how many came before this one.
  KOKKOS_FORCEINLINE_FUNCTION Id insert(Id id) const {
    const Id size = Id(1) << bits_;
    Id slot = first_slot(id);
    for (Id probe = 0; probe < size; ++probe) {
      const Id here = keys_[slot];
      if (here == id) return places_[slot];
      if (here == no_id) {
        const Id before = team::exchange_if(team_, &keys_[slot], no_id, id);
        if (before == id) return no_id;
        if (before == no_id) {
          const Id place = team::add(team_, &warp_->count, Id(1));
          list_[place] = id;
          places_[slot] = place;
          return place;
        }
      }
      slot = (slot + 1) & (size - 1);
    }
    warp_->overflow = 1;
    return no_id;
  }

  // All below: after the warp has met again.

  KOKKOS_FORCEINLINE_FUNCTION bool overflows() const { return warp_->overflow != 0; }
  KOKKOS_FORCEINLINE_FUNCTION Id size() const { return warp_->count; }

  /// Writes them to `row`, ascending; by all lanes, which see it afterwards.
  KOKKOS_FORCEINLINE_FUNCTION void write_ordered(Id* row) const {
    rank(team_, list_, size(), [&](Id i, Id id, Id place) {
      row[place] = id;
      ranks_[i] = place;
    });
  }

  /// Does rank_of hold? Too many are put in order where they came.
  KOKKOS_FORCEINLINE_FUNCTION bool remembers_ranks() const { return size() <= counting_limit; }

  /// Where in the row that write_ordered wrote the member stands before which so many came.
  KOKKOS_FORCEINLINE_FUNCTION Id rank_of(Id came) const { return ranks_[came]; }

  /// The place of a member by its id; by any lane.
  KOKKOS_FORCEINLINE_FUNCTION Id place_of(Id id, const Id* row) const {
    if (!remembers_ranks()) return place_in(row, size(), id);
    Id slot = first_slot(id);
    while (keys_[slot] != id) slot = (slot + 1) & ((Id(1) << bits_) - 1);
    return ranks_[places_[slot]];
  }

 private:
  KOKKOS_FORCEINLINE_FUNCTION Id first_slot(Id id) const {
    return static_cast<Id>((static_cast<std::uint32_t>(id) * 0x9E3779B1u) >> (32 - bits_));
  }

  const Team& team_;
  WarpShared* warp_;
  Id* keys_;
  Id* places_;  ///< slot -> place in the list
  Id* list_;    ///< members as they came
  Id* ranks_;   ///< their places in ascending order
  int bits_ = 3;
};

}  // namespace gale::detail
