#pragma once

#include <gale/base/team.hpp>
#include <gale/mesh/encoded_mesh.hpp>
#include <gale/relations/batch.hpp>
#include <gale/relations/kernels/block_pool.hpp>
#include <gale/relations/relation.hpp>
#include <gale/relations/rows.hpp>

namespace gale::detail {

/// The cells that touch a segment, in ascending order: the external ones come first, since they are internal to
/// earlier segments.
template <class Memory>
struct SegmentCells {
  const Id* external;
  Id externals;
  Id first_internal;
  Id count;

  KOKKOS_FORCEINLINE_FUNCTION SegmentCells(const EncodedMesh<Memory>& mesh, Id segment)
      : external(mesh.external.data() + mesh.external_begin(segment)),
        externals(static_cast<Id>(mesh.external_begin(segment + 1) - mesh.external_begin(segment))),
        first_internal(mesh.internal_begin(segment)),
        count(externals + mesh.internal_begin(segment + 1) - first_internal) {}

  KOKKOS_FORCEINLINE_FUNCTION Id operator[](Id i) const {
    return i < externals ? external[i] : first_internal + (i - externals);
  }
};

/// A segment as the kernels of its stars see it.
template <class Memory>
struct StarSegment {
  SegmentCells<Memory> cells;
  Id first;  ///< vertex
  Id rows;

  KOKKOS_FORCEINLINE_FUNCTION StarSegment(const EncodedMesh<Memory>& mesh, Id segment)
      : cells(mesh, segment), first(mesh.vertex_begin(segment)), rows(mesh.vertex_begin(segment + 1) - first) {}

  /// The row of a vertex, in 0..rows-1 if the segment holds it.
  KOKKOS_FORCEINLINE_FUNCTION Id row_of(Id vertex) const { return vertex - first; }
  KOKKOS_FORCEINLINE_FUNCTION bool has(Id row) const {
    return static_cast<std::uint32_t>(row) < static_cast<std::uint32_t>(rows);
  }
};

/// What the warps of a team share, at the beginning of its scratch memory, whichever way they go.
struct alignas(16) StarShared {
  StarSizes found;      ///< what this segment needs, as far as it is known
  Id longest_star;      ///< most tetrahedra at one vertex
  Id below;             ///< vertices of other segments with lower ids
  Offset vv, vt, link;  ///< where their blocks begin in the pool
};

/// Outside vertices that this many tetrahedra around a segment usually reach. The bound is some more for a
/// grid, whose segments of 64 vertices have 640 tetrahedra and reach 130; thin parts of a mesh may need more.
KOKKOS_FORCEINLINE_FUNCTION Id usual_outside(Id tetrahedra) { return tetrahedra / 5 + 64; }

/// What a star kernel is asked for. Cells have so many corners.
template <class Memory, int cell_corners>
struct StarRequest {
  static constexpr int corners = cell_corners, others = corners - 1;
  static constexpr Relation vertex_cells = gale::vertex_cells(corners - 1);

  EncodedMesh<Memory> mesh;
  SegmentList segments;  ///< of the batch, one a team
  RelationSet wanted;
  StarSizes sizes;
  BlockPool pool;

  KOKKOS_FORCEINLINE_FUNCTION bool gathers_neighbours() const { return wanted.has(Relation::VV) || wanted.has_links(); }

  /// What each team does, in the way of `Stars`.
  template <class Stars, class Team>
  KOKKOS_FORCEINLINE_FUNCTION void compute(const Team& team, char* memory) const {
    const StarSegment<Memory> segment(mesh, segments[team.league_rank()]);
    auto& shared = *reinterpret_cast<StarShared*>(memory);
    team::once(team, [&] {
      shared.found = StarSizes{};
      shared.found.rows = segment.rows;
      shared.longest_star = 0;
      shared.vv = shared.vt = shared.link = BlockPool::missing;
    });
    team::barrier(team);
    Stars(team, *this, segment, memory).compute();
    team::barrier(team);
    team::once(team, [&] { finish(team, shared); });
  }

 private:
  template <class Team>
  KOKKOS_FORCEINLINE_FUNCTION void finish(const Team& team, const detail::StarShared& shared) const {
    const bool fitted = sizes.contains(shared.found);
    if (!fitted) pool.need(team, shared.found);
    const bool done = fitted && present(vertex_cells, shared.vt) && present(Relation::VV, shared.vv) &&
                      present(link_form, shared.link);
    Offset* entry = pool.directory + Offset(team.league_rank()) * wanted.count();
    if (wanted.has(vertex_cells)) *entry++ = done ? shared.vt : BlockPool::missing;
    if (wanted.has(Relation::VV)) *entry++ = done ? shared.vv : BlockPool::missing;
    if (wanted.has_links()) *entry++ = done ? shared.link : BlockPool::missing;
  }

  KOKKOS_FORCEINLINE_FUNCTION bool present(RelationSet relation, Offset block) const {
    return !wanted.contains(relation) || block != BlockPool::missing;
  }
};

/// Reserves blocks of those that are wanted of `relations`, together: a segment that got some only would have taken
/// from the pool what others lack then. Writes the ends of the rows of VT and link, which are `star_begin`; VV has so
/// many `neighbours`.
template <class Team, class Memory, int corners>
KOKKOS_FORCEINLINE_FUNCTION void reserve_blocks(const Team& team, const StarRequest<Memory, corners>& request,
                                                RelationSet relations, StarShared& shared, Id rows,
                                                const Id* star_begin, Id neighbours) {
  const auto& pool = request.pool;
  constexpr int others = corners - 1;
  constexpr Relation vertex_cells = gale::vertex_cells(others);
  const RelationSet wanted = request.wanted & relations;
  team::once(team, [&] {
    const Id cells = shared.found.star;
    const int width = width_for(others * shared.longest_star);
    const Offset vt = wanted.has(vertex_cells) ? BlockPool::rounded(BlockLayout::words(rows, cells)) : 0;
    const Offset link =
        wanted.has_links() ? BlockPool::rounded(BlockLayout::link_words(rows, cells, width, others)) : 0;
    const Offset vv = wanted.has(Relation::VV) ? BlockLayout::words(rows, neighbours) : 0;
    const Offset begin = vt + link + vv > 0 ? pool.reserve(team, vt + link + vv) : BlockPool::missing;
    if (begin == BlockPool::missing) return;
    if (wanted.has(vertex_cells)) shared.vt = begin;
    if (wanted.has_links()) {
      shared.link = begin + vt;
      pool.words[shared.link + rows + 1] = BlockLayout::link_head(width, others);
    }
    if (wanted.has(Relation::VV)) shared.vv = begin + vt + link;
  });
  team::barrier(team);
  if (!wanted.has(vertex_cells) && !wanted.has_links()) return;
  for (const Offset block : {shared.vt, shared.link}) {
    if (block == BlockPool::missing) continue;
    team::for_all(team, rows + 1, [&](Id row) { pool.words[block + row] = star_begin[row]; });
  }
}

/// Places of a link block, in its width.
struct LinkPlaces {
  void* places = nullptr;
  int width = 1;

  LinkPlaces() = default;
  KOKKOS_FORCEINLINE_FUNCTION LinkPlaces(Id* block, Id rows) : places(block + rows + 2), width(block[rows + 1] & 255) {}

  KOKKOS_FORCEINLINE_FUNCTION Id get(Offset at) const {
    if (width == 1) return static_cast<const std::uint8_t*>(places)[at];
    if (width == 2) return static_cast<const std::uint16_t*>(places)[at];
    return static_cast<const Id*>(places)[at];
  }

  KOKKOS_FORCEINLINE_FUNCTION void put(Offset at, Id place) const {
    if (width == 1) {
      static_cast<std::uint8_t*>(places)[at] = static_cast<std::uint8_t>(place);
    } else if (width == 2) {
      static_cast<std::uint16_t*>(places)[at] = static_cast<std::uint16_t>(place);
    } else {
      static_cast<Id*>(places)[at] = place;
    }
  }
};

}  // namespace gale::detail
