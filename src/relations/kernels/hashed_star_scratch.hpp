#pragma once

#include <gale/base/team.hpp>
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

}  // namespace gale::detail
