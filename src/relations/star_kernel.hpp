#pragma once

#include <gale/base/team.hpp>
#include <gale/mesh/encoded_mesh.hpp>
#include <gale/relations/block_pool.hpp>
#include <gale/relations/detail/neighbour_set.hpp>
#include <gale/relations/detail/segment_tetrahedra.hpp>
#include <gale/relations/detail/star_scratch.hpp>
#include <gale/relations/relation.hpp>
#include <gale/relations/rows.hpp>

namespace gale {

/// Computes VV, VT and link, those of them that are wanted, for one segment a team: what the paper's Algorithms 1 and 2 do, by
/// counting, scanning and de-duplicating in the team's scratch memory, so that rows come out compact and ascending.
///
///     visit the segment's tetrahedra, count and scan: star_begin
///     reserve the blocks of VT and link, whose sizes are known now
///     visit again, and place each tetrahedron in the stars of its vertices
///     a warp a vertex: rank its star (VT); gather its neighbours, rank them, and read their places back (link)
///     reserve the block of VV, and copy the rows there
///
/// A segment that needs more scratch memory than `sizes`, or more of the pool than is left, is left out: its entries of the directory
/// say so, and `needed` or `used` what it takes.
template <class Memory>
class StarKernel {
 public:
  EncodedMesh<Memory> mesh;
  const Id* segments = nullptr;  ///< of the batch, one a team
  RelationSet wanted;
  StarSizes sizes;
  int scratch_level = 0;
  BlockPool pool;

  const char* label() const {
    if (wanted == Relation::VV) return "GALE::VV";
    if (wanted == Relation::VT) return "GALE::VT";
    if (wanted == Relation::link) return "GALE::link";
    return wanted.has(Relation::VV) && wanted.has(Relation::VT) ? "GALE::VV+VT" : "GALE::star";
  }

  /// What suffices for a segment of so many vertices and tetrahedra, unless one vertex has more than 42 tetrahedra: a link of
  /// n triangles that hang together has at most n + 2 vertices.
  static StarSizes bound(Id rows, Offset internal_tetrahedra, Offset external_tetrahedra) {
    const Offset star = 4 * internal_tetrahedra + 3 * external_tetrahedra;
    return {rows, static_cast<Id>(star), static_cast<Id>(star + 2 * Offset(rows)), 128};
  }

  /// Of a team of so many warps.
  static std::size_t scratch_bytes(const StarSizes& sizes, int warps) { return detail::StarScratch::bytes(sizes, warps); }

  template <class Team>
  KOKKOS_FUNCTION void operator()(const Team& team) const {
    const int warps = team::warps(team);
    char* const memory = team::scratch(team, scratch_level, detail::StarScratch::bytes(sizes, warps));
    const detail::StarScratch scratch(memory, sizes, warps, team::warp(team));
    const Segment segment{mesh, segments[team.league_rank()]};
    team::once(team, [&] { begin(*scratch.shared, segment); });
    team::barrier(team);
    if (fits(scratch)) count_stars(team, scratch, segment);
    team::barrier(team);
    if (fits(scratch)) {
      reserve_star_blocks(team, scratch, segment);
      fill_stars(team, scratch, segment);
      write_rows(team, scratch, segment);
      if (wanted.has(Relation::VV)) write_neighbours(team, scratch, segment);
    }
    team::barrier(team);
    team::once(team, [&] { finish(team, *scratch.shared); });
  }

 private:
  struct Segment {
    detail::SegmentTetrahedra<Memory> tetrahedra;
    Id first;
    Id rows;

    KOKKOS_FUNCTION Segment(const EncodedMesh<Memory>& mesh, Id segment)
        : tetrahedra(mesh, segment), first(mesh.vertex_begin(segment)), rows(mesh.vertex_begin(segment + 1) - first) {}

    /// The row of a vertex, in 0..rows-1 if the segment holds it.
    KOKKOS_FUNCTION Id row_of(Id vertex) const { return vertex - first; }
    KOKKOS_FUNCTION bool has(Id row) const { return static_cast<std::uint32_t>(row) < static_cast<std::uint32_t>(rows); }
  };

  KOKKOS_FUNCTION bool gathers_neighbours() const { return wanted.has(Relation::VV) || wanted.has(Relation::link); }
  KOKKOS_FUNCTION bool fits(const detail::StarScratch& scratch) const { return sizes.contains(scratch.shared->found); }

  KOKKOS_FUNCTION static void begin(detail::StarShared& shared, const Segment& segment) {
    shared.found = StarSizes{};
    shared.found.rows = segment.rows;
    shared.longest_star = 0;
    shared.vv = shared.vt = shared.link = BlockPool::missing;
  }

  /// Calls visit(row, t) for each vertex of the segment and each tetrahedron of its star.
  template <class Team, class Visit>
  KOKKOS_FUNCTION void for_each_corner(const Team& team, const Segment& segment, const Visit& visit) const {
    team::for_all(team, segment.tetrahedra.count, [&](Id i) {
      const Id t = segment.tetrahedra[i];
      for (int corner = 0; corner < 4; ++corner) {
        const Id row = segment.row_of(mesh.tetrahedra(t, corner));
        if (segment.has(row)) visit(row, t);
      }
    });
  }

  template <class Team>
  KOKKOS_FUNCTION void count_stars(const Team& team, const detail::StarScratch& scratch, const Segment& segment) const {
    team::for_all(team, segment.rows, [&](Id row) { scratch.star_begin[row] = scratch.filled[row] = 0; });
    team::barrier(team);
    for_each_corner(team, segment, [&](Id row, Id) { team::add(team, &scratch.star_begin[row], Id(1)); });
    team::barrier(team);
    auto& shared = *scratch.shared;
    team::for_all(team, segment.rows, [&](Id row) { team::raise(team, &shared.longest_star, scratch.star_begin[row]); });
    team::exclusive_scan(team, segment.rows, scratch.star_begin);
    team::once(team, [&] { shared.found.star = scratch.star_begin[segment.rows]; });
  }

  template <class Team>
  KOKKOS_FUNCTION void reserve_star_blocks(const Team& team, const detail::StarScratch& scratch, const Segment& segment) const {
    auto& shared = *scratch.shared;
    const Id tetrahedra = shared.found.star;
    team::once(team, [&] {
      if (wanted.has(Relation::VT)) shared.vt = pool.reserve(team, BlockLayout::words(segment.rows, tetrahedra));
      if (!wanted.has(Relation::link)) return;
      const int width = width_for(3 * shared.longest_star);
      shared.link = pool.reserve(team, BlockLayout::link_words(segment.rows, tetrahedra, width));
      if (shared.link != BlockPool::missing) pool.words[shared.link + segment.rows + 1] = width;
    });
    team::barrier(team);
    for (const Offset block : {shared.vt, shared.link}) {
      if (block == BlockPool::missing) continue;
      team::for_all(team, segment.rows + 1, [&](Id row) { pool.words[block + row] = scratch.star_begin[row]; });
    }
  }

  template <class Team>
  KOKKOS_FUNCTION void fill_stars(const Team& team, const detail::StarScratch& scratch, const Segment& segment) const {
    for_each_corner(team, segment, [&](Id row, Id t) {
      scratch.star[scratch.star_begin[row] + team::add(team, &scratch.filled[row], Id(1))] = t;
    });
    team::barrier(team);
  }

  template <class Team>
  KOKKOS_FUNCTION void write_rows(const Team& team, const detail::StarScratch& scratch, const Segment& segment) const {
    team::for_warps(team, segment.rows, [&](Id row) {
      Id* const star = scratch.star + scratch.star_begin[row];
      const Id tetrahedra = scratch.star_begin[row + 1] - scratch.star_begin[row];
      write_star(team, scratch, segment, row, star, tetrahedra);
      if (gathers_neighbours()) gather_neighbours(team, scratch, segment, row, star, tetrahedra);
    });
  }

  /// Calls visit(t, place) for the tetrahedra of a star, with their places in ascending order. A team of one thread placed them so.
  template <class Team, class Visit>
  KOKKOS_FUNCTION void for_each_ranked(const Team& team, Id* star, Id tetrahedra, const Visit& visit) const {
    if constexpr (is_sequential<Team>) {
      for (Id i = 0; i < tetrahedra; ++i) visit(star[i], i);
    } else {
      detail::rank(team, star, tetrahedra, [&](Id, Id t, Id place) { visit(t, place); });
    }
  }

  template <class Team>
  KOKKOS_FUNCTION void write_star(const Team& team, const detail::StarScratch& scratch, const Segment& segment, Id row, Id* star,
                                  Id tetrahedra) const {
    if (scratch.shared->vt == BlockPool::missing) return;
    Id* const out = pool.words + scratch.shared->vt + segment.rows + 1 + scratch.star_begin[row];
    for_each_ranked(team, star, tetrahedra, [&](Id t, Id place) { out[place] = t; });
  }

  /// Calls visit(vertex, place) for the three vertices of a tetrahedron that are not `vertex`, ascending.
  template <class Visit>
  KOKKOS_FUNCTION void for_each_other(Id t, Id vertex, const Visit& visit) const {
    int place = 0;
    for (int corner = 0; corner < 4; ++corner) {
      const Id other = mesh.tetrahedra(t, corner);
      if (other != vertex) visit(other, place++);
    }
  }

  template <class Team>
  KOKKOS_FUNCTION void gather_neighbours(const Team& team, const detail::StarScratch& scratch, const Segment& segment, Id row,
                                         Id* star, Id tetrahedra) const {
    auto& shared = *scratch.shared;
    const Id vertex = segment.first + row;
    const detail::NeighbourSet<Team> neighbours(team, scratch, sizes.slots, tetrahedra);
    team::for_lanes(team, tetrahedra, [&](Id i) {
      for_each_other(star[i], vertex, [&](Id other, int) { neighbours.insert(other); });
    });
    team::once_per_warp(team, [&] {
      const Id count = neighbours.size();
      scratch.warp->place = team::add(team, &shared.found.neighbours, count);
      scratch.row_place[row] = scratch.warp->place;
      scratch.degree[row] = count;
      if (neighbours.overflows()) team::raise(team, &shared.found.slots, slots_for(shared.longest_star));
    });
    team::warp_barrier(team);
    if (neighbours.overflows() || scratch.warp->place + neighbours.size() > sizes.neighbours) return;
    Id* const out = scratch.neighbours + scratch.warp->place;
    neighbours.write_ordered(out);
    if (shared.link == BlockPool::missing) return;
    const int width = pool.words[shared.link + segment.rows + 1];
    void* const link = pool.words + shared.link + segment.rows + 2;
    for_each_ranked(team, star, tetrahedra, [&](Id t, Id place) {
      const Offset at = 3 * (Offset(scratch.star_begin[row]) + place);
      for_each_other(t, vertex, [&](Id other, int corner) { put(link, width, at + corner, neighbours.place_of(other, out)); });
    });
  }

  KOKKOS_FUNCTION static Id slots_for(Id longest_star) {
    Id slots = 8;
    while (slots < 3 * Offset(longest_star)) slots *= 2;
    return slots;
  }

  KOKKOS_FUNCTION static void put(void* places, int width, Offset at, Id place) {
    if (width == 1) {
      static_cast<std::uint8_t*>(places)[at] = static_cast<std::uint8_t>(place);
    } else if (width == 2) {
      static_cast<std::uint16_t*>(places)[at] = static_cast<std::uint16_t>(place);
    } else {
      static_cast<Id*>(places)[at] = place;
    }
  }

  template <class Team>
  KOKKOS_FUNCTION void write_neighbours(const Team& team, const detail::StarScratch& scratch, const Segment& segment) const {
    team::barrier(team);
    if (!fits(scratch)) return;
    team::exclusive_scan(team, segment.rows, scratch.degree);
    auto& shared = *scratch.shared;
    team::once(team, [&] { shared.vv = pool.reserve(team, BlockLayout::words(segment.rows, shared.found.neighbours)); });
    team::barrier(team);
    if (shared.vv == BlockPool::missing) return;
    Id* const offsets = pool.words + shared.vv;
    Id* const ids = offsets + segment.rows + 1;
    team::for_all(team, segment.rows + 1, [&](Id row) { offsets[row] = scratch.degree[row]; });
    team::for_warps(team, segment.rows, [&](Id row) {
      const Id to = scratch.degree[row];
      const Id* const from = scratch.neighbours + scratch.row_place[row];
      team::for_lanes(team, scratch.degree[row + 1] - to, [&](Id i) { ids[to + i] = from[i]; });
    });
  }

  template <class Team>
  KOKKOS_FUNCTION void finish(const Team& team, const detail::StarShared& shared) const {
    const bool fitted = sizes.contains(shared.found);
    if (!fitted) pool.need(team, shared.found);
    const bool done = fitted && present(Relation::VT, shared.vt) && present(Relation::VV, shared.vv) && present(Relation::link, shared.link);
    Offset* entry = pool.directory + Offset(team.league_rank()) * wanted.count();
    if (wanted.has(Relation::VT)) *entry++ = done ? shared.vt : BlockPool::missing;
    if (wanted.has(Relation::VV)) *entry++ = done ? shared.vv : BlockPool::missing;
    if (wanted.has(Relation::link)) *entry++ = done ? shared.link : BlockPool::missing;
  }

  KOKKOS_FUNCTION bool present(Relation relation, Offset block) const {
    return !wanted.has(relation) || block != BlockPool::missing;
  }
};

}  // namespace gale
