#pragma once

#include <gale/relations/kernels/bit_stars.hpp>
#include <gale/relations/kernels/hashed_stars.hpp>

namespace gale::detail {

/// BitStars on Kokkos' teams, in scratch memory of a level.
template <class Memory, int level>
struct BitStarTeams {
  StarRequest<Memory> request;

  template <class Team>
  KOKKOS_FUNCTION void operator()(const Team& team) const {
    request.template compute<BitStars<Team, Memory>>(
        team, team::scratch<level>(team, BitStarScratch(nullptr, request.sizes).bytes));
  }
};

/// HashedStars, likewise.
template <class Memory, int level>
struct HashedStarTeams {
  StarRequest<Memory> request;

  template <class Team>
  KOKKOS_FUNCTION void operator()(const Team& team) const {
    request.template compute<HashedStars<Team, Memory>>(
        team, team::scratch<level>(team, HashedStarScratch::bytes(request.sizes, team::warps(team))));
  }
};

}  // namespace gale::detail
