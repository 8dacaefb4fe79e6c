#pragma once

#include <gale/relations/kernels/bit_stars.hpp>
#include <gale/relations/kernels/hashed_stars.hpp>
#include <gale/relations/kernels/launch.hpp>

namespace gale {

namespace detail {

/// BitStars or HashedStars on Kokkos' teams, in scratch memory of a level.
template <template <class, class, int> class Stars, class Memory, int corners, int level>
struct StarTeams {
  StarRequest<Memory, corners> request;

  template <class Team>
  KOKKOS_FUNCTION void operator()(const Team& team) const {
    using OfTeam = Stars<Team, Memory, corners>;
    const std::size_t bytes = OfTeam::scratch_bytes(request.sizes, team::warps(team));
    request.template compute<OfTeam>(team, team::scratch<level>(team, bytes));
  }
};

}  // namespace detail

/// Computes VV, VT and link, those of them that are wanted, for one segment a team: what the paper's Algorithms 1 and 2
/// do, in the team's scratch memory, so that rows come out compact and ascending. There are two ways, which the sizes
/// decide on: BitStars for small segments on Kokkos' teams, HashedStars for all others and for a HostTeam.
///
/// A segment that needs more scratch memory than `sizes`, or more of the pool than is left, is left out: its entries of
/// the directory say so, and `needed` or `used` what it takes.
template <class Memory, int cell_corners>
class StarKernel : public detail::StarRequest<Memory, cell_corners> {
 public:
  using Request = detail::StarRequest<Memory, cell_corners>;
  using Request::corners;
  using Request::vertex_cells;
  using Request::wanted;
  int scratch_level = 0;

  const char* label() const {
    if (wanted == Relation::VV) return "GALE::VV";
    if (wanted == vertex_cells) return corners == 4 ? "GALE::VT" : "GALE::VF";
    if (wanted == link_form) return "GALE::link";
    return !wanted.has(Relation::VV) || !wanted.has(vertex_cells) ? "GALE::star"
           : corners == 4                                         ? "GALE::VV+VT"
                                                                  : "GALE::VV+VF";
  }

  /// What suffices for a segment of so many vertices and cells, unless one vertex has more than 42 tetrahedra (a
  /// link of n triangles that hang together has at most n + 2 vertices), or the segment lies in a part of the mesh that
  /// has little but surface.
  static StarSizes bound(Id rows, Offset internal, Offset external,
                         RelationSet wanted = star_relations_of(corners - 1)) {
    const Offset star = corners * internal + (corners - 1) * external, cells = internal + external;
    StarSizes sizes;
    sizes.rows = rows;
    sizes.star = static_cast<Id>(star);
    sizes.neighbours = static_cast<Id>(star + 2 * Offset(rows));
    sizes.slots = 128;
    sizes.cells = static_cast<Id>(cells);
    sizes.outside = wanted == vertex_cells ? 0 : detail::usual_outside(static_cast<Id>(cells));
    return sizes;
  }

  /// The scratch memory of a team of so many warps.
  static std::size_t scratch_bytes(const StarSizes& sizes, int warps) {
    const std::size_t hashed = detail::HashedStars<HostTeam, Memory, corners>::scratch_bytes(sizes, warps);
    if (!is_small(sizes)) return hashed;
    const std::size_t bits = detail::BitStars<HostTeam, Memory, corners>::scratch_bytes(sizes, warps);
    return is_device_memory<Memory> || bits > hashed ? bits : hashed;  // a HostTeam takes the other way
  }

  /// On the calling thread.
  void operator()(const HostTeam& team) const {
    this->template compute<detail::HashedStars<HostTeam, Memory, corners>>(team, team.scratch());
  }

  /// Calls use(functor) with what Kokkos is to run on its teams. Each has one way, one kind of scratch memory: one
  /// functor for all would take the registers of the greediest, and a third fewer teams would run at a time.
  template <class Use>
  void use_on_teams(const Use& use) const {
    is_small(this->sizes) ? use_way<detail::BitStars>(use) : use_way<detail::HashedStars>(use);
  }

 private:
  template <template <class, class, int> class Stars, class Use>
  void use_way(const Use& use) const {
    at_scratch_level<Memory>(scratch_level,
                             [&](auto level) { use(detail::StarTeams<Stars, Memory, corners, level>{*this}); });
  }

  static bool is_small(const StarSizes& sizes) { return detail::BitStars<HostTeam, Memory, corners>::is_for(sizes); }
};

}  // namespace gale
