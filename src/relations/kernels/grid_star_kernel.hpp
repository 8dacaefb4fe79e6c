#pragma once

#include <gale/base/team.hpp>
#include <gale/mesh/mesh.hpp>
#include <gale/relations/batch.hpp>
#include <gale/relations/kernels/block_pool.hpp>
#include <gale/relations/kernels/launch.hpp>
#include <gale/relations/relation.hpp>
#include <gale/relations/rows.hpp>

namespace gale {

/// Computes VV, VT (VF of squares) and link, those of them that are wanted, for one segment of a grid a team: what
/// StarKernel does, of places instead of cells.
///
///     a lane a vertex: what its star's kind has
///     scan; reserve the blocks
///     a lane a vertex: write its rows
///
/// A segment of more rows than `sizes` says, or for whose blocks the pool has no room, is left out likewise.
template <class Memory>
class GridStarKernel {
 public:
  SegmentList segments;  ///< of the batch, one a team
  StarSizes sizes;       ///< rows alone count
  int scratch_level = 0;
  BlockPool pool;

  GridStarKernel(const Mesh& mesh, RelationSet wanted)
      : grid_(mesh.grid()->template in<Memory>()),
        kinds_(mesh.grid()->template kinds_in<Memory>()),
        vertex_begin_(mesh.interval_begin<Memory>(0).data()),
        wanted_(wanted) {}

  const char* label() const { return "GALE::grid_stars"; }

  KOKKOS_FUNCTION static std::size_t scratch_bytes(const StarSizes& sizes, int /*warps*/) {
    return sizeof(Shared) + 2 * (std::size_t(sizes.rows) + 1) * sizeof(Id);
  }

  /// On the calling thread.
  void operator()(const HostTeam& team) const { compute(team, team.scratch()); }

  /// Calls use(functor) with what Kokkos is to run on its teams: one for each level of scratch memory.
  template <class Use>
  void use_on_teams(const Use& use) const {
    at_scratch_level<Memory>(scratch_level, [&](auto level) { use(OnTeams<level>{*this}); });
  }

  template <int level>
  struct OnTeams {
    GridStarKernel kernel;

    template <class Team>
    KOKKOS_FUNCTION void operator()(const Team& team) const {
      kernel.compute(team, team::scratch<level>(team, scratch_bytes(kernel.sizes, 1)));
    }
  };

  template <class Team>
  KOKKOS_FORCEINLINE_FUNCTION void compute(const Team& team, char* memory) const {
    Shared& shared = *reinterpret_cast<Shared*>(memory);
    Id* const neighbours = reinterpret_cast<Id*>(memory + sizeof(Shared));
    Id* const cells = neighbours + sizes.rows + 1;
    const Id segment = segments[team.league_rank()];
    const Id first = vertex_begin_[segment], rows = vertex_begin_[segment + 1] - first;
    Offset* const entries = pool.directory + Offset(team.league_rank()) * wanted_.count();
    if (rows > sizes.rows) {
      team::once(team, [&] {
        for (int i = 0; i < wanted_.count(); ++i) entries[i] = BlockPool::missing;
        pool.need(team, {rows, 0, 0, 0, 0, 0});
      });
      return;
    }
    detail::GridCursor counted(grid_);
    team::for_all(team, rows, [&](Id row) {
      counted.go_to(first + row);
      const detail::StarKind& kind = kinds_[counted.kind()];
      neighbours[row] = kind.neighbours;
      cells[row] = kind.cells;
    });
    team::exclusive_scan(team, rows, neighbours);
    team::exclusive_scan(team, rows, cells);
    team::once(team, [&] { reserve(team, rows, neighbours[rows], cells[rows], shared, entries); });
    team::barrier(team);
    if (shared.begin == BlockPool::missing) return;
    write(team, first, rows, neighbours, cells, shared);
  }

 private:
  /// Where blocks begin in the pool; below 0 where they aren't wanted, or, of `begin`, where there is no room.
  struct alignas(16) Shared {
    Offset begin, vt, vv, link;
  };

  /// By one lane. Blocks are entries of the directory in this order.
  template <class Team>
  KOKKOS_FORCEINLINE_FUNCTION void reserve(const Team& team, Id rows, Id neighbours, Id cells, Shared& shared,
                                           Offset* entries) const {
    const int others = grid_.dimension;
    const bool has_cells = wanted_.has(vertex_cells(others)), has_neighbours = wanted_.has(Relation::VV);
    const Offset vt = has_cells ? BlockPool::rounded(BlockLayout::words(rows, cells)) : 0;
    const Offset vv = has_neighbours ? BlockPool::rounded(BlockLayout::words(rows, neighbours)) : 0;
    const Offset link = wanted_.has_links() ? BlockLayout::link_words(rows, cells, 1, others) : 0;
    shared.begin = pool.reserve(team, vt + vv + link);
    const bool fits = shared.begin != BlockPool::missing;
    shared.vt = fits && has_cells ? shared.begin : BlockPool::missing;
    shared.vv = fits && has_neighbours ? shared.begin + vt : BlockPool::missing;
    shared.link = fits && wanted_.has_links() ? shared.begin + vt + vv : BlockPool::missing;
    if (shared.link != BlockPool::missing) pool.words[shared.link + rows + 1] = BlockLayout::link_head(1, others);
    const auto enter = [&](bool is_wanted, Offset block) {
      if (is_wanted) *entries++ = block;
    };
    // VF comes before VV among relations, and so does VT.
    enter(has_cells, shared.vt);
    enter(has_neighbours, shared.vv);
    enter(wanted_.has_links(), shared.link);
  }

  template <class Team>
  KOKKOS_FORCEINLINE_FUNCTION void write(const Team& team, Id first, Id rows, const Id* neighbours, const Id* cells,
                                         const Shared& shared) const {
    Id* const vt = shared.vt < 0 ? nullptr : pool.words + shared.vt;
    Id* const vv = shared.vv < 0 ? nullptr : pool.words + shared.vv;
    Id* const link = shared.link < 0 ? nullptr : pool.words + shared.link;
    team::for_all(team, rows + 1, [&](Id row) {
      if (vt != nullptr) vt[row] = cells[row];
      if (vv != nullptr) vv[row] = neighbours[row];
      if (link != nullptr) link[row] = cells[row];
    });
    const int others = grid_.dimension;
    auto* const places = link == nullptr ? nullptr : reinterpret_cast<std::uint8_t*>(link + rows + 2);
    detail::GridCursor at(grid_);
    team::for_all(team, rows, [&](Id row) {
      at.go_to(first + row);
      const detail::StarKind& kind = kinds_[at.kind()];
      if (vt != nullptr) {
        Id* const to = vt + rows + 1 + cells[row];
        for (int i = 0; i < kind.cells; ++i) to[i] = at.cell(kind.cell[i]);
      }
      if (vv != nullptr) {
        Id* const to = vv + rows + 1 + neighbours[row];
        for (int i = 0; i < kind.neighbours; ++i) to[i] = at.neighbour(kind.direction[i]);
      }
      if (link != nullptr) {
        std::uint8_t* const to = places + others * cells[row];
        for (int i = 0; i < others * kind.cells; ++i) to[i] = kind.link[i];
      }
    });
  }

  GridView grid_;
  const detail::StarKind* kinds_;
  const Id* vertex_begin_;
  RelationSet wanted_;
};

}  // namespace gale
