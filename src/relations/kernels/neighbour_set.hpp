#pragma once

#include <gale/base/team.hpp>
#include <gale/base/types.hpp>
#include <gale/relations/kernels/ranking.hpp>
#include <gale/relations/kernels/star_request.hpp>

namespace gale::detail {

/// What one warp works with while it computes the neighbours of one vertex.
struct WarpShared {
  Id count;     ///< neighbours found so far
  Id overflow;  ///< not 0: the slots didn't suffice
  Id place;     ///< where their row lies among those of the segment
  Id padding;
};

/// The scratch memory of a team that goes the way of HashedStars, divided.
struct HashedStarScratch {
  StarShared* shared;
  Id* star_begin;  ///< rows + 1
  Id* filled;      ///< rows: entries of each star placed so far
  Id* degree;      ///< rows + 1: neighbours of each vertex, later where its VV row begins
  Id* row_place;   ///< rows: where they lie in `neighbours`
  Id* star;        ///< tetrahedra, vertex after vertex
  Id* neighbours;
  WarpShared* warp;
  Id* keys;    ///< slots, of this warp
  Id* places;  ///< slots, of this warp
  Id* list;    ///< slots, of this warp
  Id* ranks;   ///< slots, of this warp

  KOKKOS_FORCEINLINE_FUNCTION static std::size_t bytes(const StarSizes& sizes, int warps) {
    const std::size_t ids = std::size_t(4) * (sizes.rows + 4) + rounded(sizes.star) + rounded(sizes.neighbours) +
                            std::size_t(4) * warps * rounded(sizes.slots);
    return ids * sizeof(Id) + sizeof(StarShared) + warps * sizeof(WarpShared);
  }

  KOKKOS_FORCEINLINE_FUNCTION HashedStarScratch(char* memory, const StarSizes& sizes, int warps, int this_warp) {
    const auto take = [&memory](std::size_t count) {
      char* const taken = memory;
      memory += count;
      return taken;
    };
    const auto take_ids = [&](std::size_t count) { return reinterpret_cast<Id*>(take(count * sizeof(Id))); };
    shared = reinterpret_cast<StarShared*>(take(sizeof(StarShared)));
    warp = reinterpret_cast<WarpShared*>(take(warps * sizeof(WarpShared))) + this_warp;
    star_begin = take_ids(sizes.rows + 4);
    filled = take_ids(sizes.rows + 4);
    degree = take_ids(sizes.rows + 4);
    row_place = take_ids(sizes.rows + 4);
    star = take_ids(rounded(sizes.star));
    neighbours = take_ids(rounded(sizes.neighbours));
    Id* const tables = take_ids(std::size_t(4) * warps * rounded(sizes.slots));
    keys = tables + std::size_t(4) * this_warp * rounded(sizes.slots);
    places = keys + rounded(sizes.slots);
    list = places + rounded(sizes.slots);
    ranks = list + rounded(sizes.slots);
  }

 private:
  KOKKOS_FORCEINLINE_FUNCTION static std::size_t rounded(std::size_t count, std::size_t to = 4) {
    return (count + to - 1) / to * to;
  }
};

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
