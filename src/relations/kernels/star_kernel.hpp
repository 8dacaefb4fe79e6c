#pragma once

#include <gale/relations/kernels/bit_stars.hpp>
#include <gale/relations/kernels/hashed_stars.hpp>

namespace gale {

namespace detail {

/// BitStars or HashedStars on Kokkos' teams, in scratch memory of a level.
template <template <class, class> class Stars, class Memory, int level>
struct StarTeams {
  StarRequest<Memory> request;

  template <class Team>
  KOKKOS_FUNCTION void operator()(const Team& team) const {
    using OfTeam = Stars<Team, Memory>;
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
template <class Memory>
class StarKernel : public detail::StarRequest<Memory> {
 public:
  using detail::StarRequest<Memory>::wanted;
  int scratch_level = 0;

  const char* label() const {
    if (wanted == Relation::VV) return "GALE::VV";
    if (wanted == Relation::VT) return "GALE::VT";
    if (wanted == link_form) return "GALE::link";
    return wanted.has(Relation::VV) && wanted.has(Relation::VT) ? "GALE::VV+VT" : "GALE::star";
  }

  /// What suffices for a segment of so many vertices and tetrahedra, unless one vertex has more than 42 tetrahedra (a
  /// link of n triangles that hang together has at most n + 2 vertices), or the segment lies in a part of the mesh that
  /// has little but surface.
  static StarSizes bound(Id rows, Offset internal_tetrahedra, Offset external_tetrahedra,
                         RelationSet wanted = star_relations) {
    const Offset star = 4 * internal_tetrahedra + 3 * external_tetrahedra;
    const Offset tetrahedra = internal_tetrahedra + external_tetrahedra;
    StarSizes sizes;
    sizes.rows = rows;
    sizes.star = static_cast<Id>(star);
    sizes.neighbours = static_cast<Id>(star + 2 * Offset(rows));
    sizes.slots = 128;
    sizes.tetrahedra = static_cast<Id>(tetrahedra);
    sizes.outside = wanted == Relation::VT ? 0 : detail::usual_outside(static_cast<Id>(tetrahedra));
    return sizes;
  }

  /// The scratch memory of a team of so many warps.
  static std::size_t scratch_bytes(const StarSizes& sizes, int warps) {
    const std::size_t hashed = detail::HashedStars<HostTeam, Memory>::scratch_bytes(sizes, warps);
    if (!is_small(sizes)) return hashed;
    const std::size_t bits = detail::BitStars<HostTeam, Memory>::scratch_bytes(sizes, warps);
    return is_device_memory<Memory> || bits > hashed ? bits : hashed;  // a HostTeam takes the other way
  }

  /// On the calling thread.
  void operator()(const HostTeam& team) const {
    this->template compute<detail::HashedStars<HostTeam, Memory>>(team, team.scratch());
  }

  /// Calls use(functor) with what Kokkos is to run on its teams. Each has one way, one kind of scratch memory: one
  /// functor for all would take the registers of the greediest, and a third fewer teams would run at a time.
  template <class Use>
  friend void with_functor(const StarKernel& kernel, const Use& use) {
    is_small(kernel.sizes) ? kernel.template use_on_teams<detail::BitStars>(use)
                           : kernel.template use_on_teams<detail::HashedStars>(use);
  }

 private:
  template <template <class, class> class Stars, class Use>
  void use_on_teams(const Use& use) const {
    scratch_level == 0 ? use(detail::StarTeams<Stars, Memory, 0>{*this})
                       : use(detail::StarTeams<Stars, Memory, 1>{*this});
  }

  static bool is_small(const StarSizes& sizes) { return detail::BitStars<HostTeam, Memory>::is_for(sizes); }
};

}  // namespace gale
