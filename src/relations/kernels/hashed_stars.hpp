#pragma once

#include <gale/relations/kernels/neighbour_set.hpp>
#include <gale/relations/kernels/star_request.hpp>

namespace gale::detail {

/// The stars of a segment of any size, by counting, scanning and, for each vertex, a hash set of a warp's own; scratch
/// memory in proportion to the stars. What one host thread does, and what is left of a mesh for a device where segments
/// are too large for BitStars.
///
///     visit the segment's cells, count and scan: star_begin
///     reserve the blocks of VT and link, whose sizes are known now
///     visit again, and place each cell in the stars of its vertices
///     a warp a vertex: rank its star (VT); gather its neighbours, rank them, and read their places back (link)
///     reserve the block of VV, and copy the rows there
template <class Team, class Memory, int corners>
class HashedStars {
 public:
  using Request = StarRequest<Memory, corners>;
  using Segment = StarSegment<Memory>;

  KOKKOS_FORCEINLINE_FUNCTION static std::size_t scratch_bytes(const StarSizes& sizes, int warps) {
    return HashedStarScratch::bytes(sizes, warps);
  }

  KOKKOS_FORCEINLINE_FUNCTION HashedStars(const Team& team, const Request& request, const Segment& segment,
                                          char* memory)
      : team_(team),
        request_(request),
        segment_(segment),
        scratch_(memory, request.sizes, team::warps(team), team::warp(team)) {}

  /// By all. Leaves blocks in the pool and in StarShared, where it fits.
  KOKKOS_FORCEINLINE_FUNCTION void compute() const {
    if (fits()) count_stars();
    team::barrier(team_);
    if (!fits()) return;
    reserve_blocks(team_, request_, vertex_cells(corners - 1) | link_form, *scratch_.shared, segment_.rows,
                   scratch_.star_begin, 0);
    fill_stars();
    write_rows();
    if (request_.wanted.has(Relation::VV)) write_neighbours();
  }

 private:
  static constexpr int others = corners - 1;

  KOKKOS_FORCEINLINE_FUNCTION bool fits() const { return request_.sizes.contains(scratch_.shared->found); }

  /// Calls visit(row, t) for each vertex of the segment and each cell of its star.
  template <class Visit>
  KOKKOS_FORCEINLINE_FUNCTION void for_each_corner(const Visit& visit) const {
    team::for_all(team_, segment_.cells.count, [&](Id i) {
      const Id t = segment_.cells[i];
      for (int corner = 0; corner < corners; ++corner) {
        const Id row = segment_.row_of(request_.mesh.cells(t, corner));
        if (segment_.has(row)) visit(row, t);
      }
    });
  }

  KOKKOS_FORCEINLINE_FUNCTION void count_stars() const {
    team::for_all(team_, segment_.rows, [&](Id row) { scratch_.star_begin[row] = scratch_.filled[row] = 0; });
    team::barrier(team_);
    for_each_corner([&](Id row, Id) { team::add(team_, &scratch_.star_begin[row], Id(1)); });
    team::barrier(team_);
    auto& shared = *scratch_.shared;
    team::for_all(team_, segment_.rows,
                  [&](Id row) { team::raise(team_, &shared.longest_star, scratch_.star_begin[row]); });
    team::exclusive_scan(team_, segment_.rows, scratch_.star_begin);
    team::once(team_, [&] { shared.found.star = scratch_.star_begin[segment_.rows]; });
  }

  KOKKOS_FORCEINLINE_FUNCTION void fill_stars() const {
    for_each_corner([&](Id row, Id t) {
      scratch_.star[scratch_.star_begin[row] + team::add(team_, &scratch_.filled[row], Id(1))] = t;
    });
    team::barrier(team_);
  }

  KOKKOS_FORCEINLINE_FUNCTION void write_rows() const {
    team::for_warps(team_, segment_.rows, [&](Id row) {
      Id* const star = scratch_.star + scratch_.star_begin[row];
      const Id cells = scratch_.star_begin[row + 1] - scratch_.star_begin[row];
      write_star(row, star, cells);
      if (request_.gathers_neighbours()) gather_neighbours(row, star, cells);
    });
  }

  /// Calls visit(t, place) for the cells of a star, with their places in ascending order. A team of one thread
  /// placed them so.
  template <class Visit>
  KOKKOS_FORCEINLINE_FUNCTION void for_each_ranked(Id* star, Id cells, const Visit& visit) const {
    if constexpr (is_sequential<Team>) {
      for (Id i = 0; i < cells; ++i) visit(star[i], i);
    } else {
      detail::rank(team_, star, cells, [&](Id, Id t, Id place) { visit(t, place); });
    }
  }

  KOKKOS_FORCEINLINE_FUNCTION void write_star(Id row, Id* star, Id cells) const {
    if (scratch_.shared->vt == BlockPool::missing) return;
    Id* const out = request_.pool.words + scratch_.shared->vt + segment_.rows + 1 + scratch_.star_begin[row];
    for_each_ranked(star, cells, [&](Id t, Id place) { out[place] = t; });
  }

  /// Calls visit(vertex, place) for the vertices of a cell that are not `vertex`, ascending.
  template <class Visit>
  KOKKOS_FORCEINLINE_FUNCTION void for_each_other(Id t, Id vertex, const Visit& visit) const {
    const Id* const all = &request_.mesh.cells(t, 0);
    for (int i = 0; i < others; ++i)
      visit(all[i + (all[i] >= vertex ? 1 : 0)], i);  // cells' vertices ascend: no branch
  }

  KOKKOS_FORCEINLINE_FUNCTION void gather_neighbours(Id row, Id* star, Id cells) const {
    auto& shared = *scratch_.shared;
    const Id vertex = segment_.first + row;
    const NeighbourSet<Team> neighbours(team_, scratch_, request_.sizes.slots, cells);
    const bool wants_link = shared.link != BlockPool::missing;
    const LinkPlaces link = wants_link ? LinkPlaces(request_.pool.words + shared.link, segment_.rows) : LinkPlaces();
    const Offset link_begin = others * Offset(scratch_.star_begin[row]);
    team::for_lanes(team_, cells, [&](Id i) {
      for_each_other(star[i], vertex, [&](Id other, int corner) {
        const Id came = neighbours.insert(other);
        if (is_sequential<Team> && wants_link) link.put(link_begin + others * i + corner, came);
      });
    });
    team::once_per_warp(team_, [&] {
      const Id count = neighbours.size();
      scratch_.warp->place = team::add(team_, &shared.found.neighbours, count);
      scratch_.row_place[row] = scratch_.warp->place;
      scratch_.degree[row] = count;
      if (neighbours.overflows()) team::raise(team_, &shared.found.slots, slots_for(shared.longest_star));
    });
    team::warp_barrier(team_);
    if (neighbours.overflows() || scratch_.warp->place + neighbours.size() > request_.sizes.neighbours) return;
    Id* const out = scratch_.neighbours + scratch_.warp->place;
    neighbours.write_ordered(out);
    if (!wants_link) return;
    if (is_sequential<Team> && neighbours.remembers_ranks()) {
      for (Offset at = link_begin; at < link_begin + others * Offset(cells); ++at)
        link.put(at, neighbours.rank_of(link.get(at)));
      return;
    }
    for_each_ranked(star, cells, [&](Id t, Id place) {
      for_each_other(t, vertex, [&](Id other, int corner) {
        link.put(link_begin + others * Offset(place) + corner, neighbours.place_of(other, out));
      });
    });
  }

  KOKKOS_FORCEINLINE_FUNCTION static Id slots_for(Id longest_star) {
    Id slots = 8;
    while (slots < others * Offset(longest_star)) slots *= 2;
    return slots;
  }

  KOKKOS_FORCEINLINE_FUNCTION void write_neighbours() const {
    team::barrier(team_);
    if (!fits()) return;
    team::exclusive_scan(team_, segment_.rows, scratch_.degree);
    auto& shared = *scratch_.shared;
    const auto& pool = request_.pool;
    team::once(team_,
               [&] { shared.vv = pool.reserve(team_, BlockLayout::words(segment_.rows, shared.found.neighbours)); });
    team::barrier(team_);
    if (shared.vv == BlockPool::missing) return;
    Id* const offsets = pool.words + shared.vv;
    Id* const ids = offsets + segment_.rows + 1;
    team::for_all(team_, segment_.rows + 1, [&](Id row) { offsets[row] = scratch_.degree[row]; });
    team::for_warps(team_, segment_.rows, [&](Id row) {
      const Id to = scratch_.degree[row];
      const Id* const from = scratch_.neighbours + scratch_.row_place[row];
      team::for_lanes(team_, scratch_.degree[row + 1] - to, [&](Id i) { ids[to + i] = from[i]; });
    });
  }

  const Team& team_;
  const Request& request_;
  const Segment& segment_;
  HashedStarScratch scratch_;
};

}  // namespace gale::detail
