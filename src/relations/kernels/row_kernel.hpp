#pragma once

#include <cstdint>
#include <string>
#include <type_traits>

#include <gale/base/team.hpp>
#include <gale/mesh/simplices.hpp>
#include <gale/relations/batch.hpp>
#include <gale/relations/kernels/block_pool.hpp>
#include <gale/relations/kernels/launch.hpp>
#include <gale/relations/kernels/row_entries.hpp>
#include <gale/relations/rows.hpp>

namespace gale {

namespace detail {

/// Up to how many entries of a row its lane keeps from counting to writing, so that it needn't find them twice: as many
/// as most rows have, unless finding them is no work. On a device scratch memory is short.
KOKKOS_FUNCTION constexpr Id stash_capacity(Relation relation, bool on_device) {
  if (relation == Relation::VF) return 40;
  if (relation == Relation::EF || relation == Relation::ET) return 8;
  if (relation == Relation::FF) return on_device ? 0 : 18;
  if (relation == Relation::FT) return 2;
  return relation == Relation::TT ? 4 : 0;
}

/// The first entries of each row of a segment, in ascending order, in its scratch memory. Those of neighbouring rows
/// lie side by side.
template <Relation relation, bool on_device>
class RowStash {
 public:
  /// Nothing is kept in segments of more rows.
  static constexpr Id most_rows = 4096;

  KOKKOS_INLINE_FUNCTION static constexpr Id capacity_for(Id rows) {
    return rows > most_rows ? 0 : stash_capacity(relation, on_device);
  }

  /// In memory for rows * capacity_for(rows) ids.
  KOKKOS_INLINE_FUNCTION RowStash(Id* ids, Id rows) : ids_(ids), rows_(rows), capacity_(capacity_for(rows)) {}

  KOKKOS_INLINE_FUNCTION Id capacity() const { return capacity_; }

  /// Adds the entry that comes after `count` others, if there is room.
  KOKKOS_INLINE_FUNCTION void add(Id row, Id count, Id id) const {
    if (count >= capacity_) return;
    Id at = count;
    if constexpr (!visits_in_order(relation)) {
      for (; at > 0 && ids_[(at - 1) * rows_ + row] > id; --at) ids_[at * rows_ + row] = ids_[(at - 1) * rows_ + row];
    }
    ids_[at * rows_ + row] = id;
  }

  KOKKOS_INLINE_FUNCTION void read(Id row, Id count, Id* to) const {
    for (Id i = 0; i < count; ++i) to[i] = ids_[i * rows_ + row];
  }

 private:
  Id* ids_;
  Id rows_;
  Id capacity_;
};

}  // namespace detail

/// Computes one relation other than VV, VT and link for one segment a team: the rows of the simplices that are internal
/// to it, compact and ascending.
///
///     a lane a row: find its entries, count them, and keep the first few
///     scan; reserve the block
///     a lane a row: write them, found again if there were more
///
/// A segment of more rows than `sizes` says, or for whose block the pool has no room, is left out, as StarKernel does.
template <Relation relation, class Memory>
class RowKernel {
 public:
  Simplices<Memory> simplices;
  Kokkos::View<const Id*, Memory, Kokkos::MemoryUnmanaged> vertex_begin;  ///< I_V
  SegmentList segments;                                                   ///< of the batch, one a team
  StarSizes sizes;                                                        ///< rows alone count
  int scratch_level = 0;
  BlockPool pool;

  const char* label() const;

  KOKKOS_FUNCTION static std::size_t scratch_bytes(const StarSizes& sizes, int /*warps*/) {
    return sizeof(Shared) + (std::size_t(sizes.rows) * (1 + Stash::capacity_for(sizes.rows)) + 1) * sizeof(Id);
  }

  /// On the calling thread.
  void operator()(const HostTeam& team) const {
    if constexpr (detail::can_bisect(relation)) {
      if (bisects()) return compute<detail::Bisect>(team, team.scratch());
    }
    compute<detail::LookThrough>(team, team.scratch());
  }

  /// Calls use(functor) with what Kokkos is to run on its teams: one for each level of scratch memory, see
  /// team::scratch, and for each way of finding entries.
  template <class Use>
  void use_on_teams(const Use& use) const {
    if constexpr (detail::can_bisect(relation)) {
      if (bisects()) return use_at_level<detail::Bisect>(use);
    }
    use_at_level<detail::LookThrough>(use);
  }

  template <int level, class Search>
  struct OnTeams {
    RowKernel kernel;

    template <class Team>
    KOKKOS_FUNCTION void operator()(const Team& team) const {
      kernel.template compute<Search>(team, team::scratch<level>(team, scratch_bytes(kernel.sizes, 1)));
    }
  };

  template <class Search, class Team>
  KOKKOS_FORCEINLINE_FUNCTION void compute(const Team& team, char* memory) const {
    Shared& shared = *reinterpret_cast<Shared*>(memory);
    auto* const begin = reinterpret_cast<std::uint32_t*>(memory + sizeof(Shared));
    const Id segment = segments[team.league_rank()];
    const Id first = first_of(vertex_begin(segment)), rows = first_of(vertex_begin(segment + 1)) - first;
    Offset* const entry = pool.directory + team.league_rank();
    if (rows > sizes.rows) {
      team::once(team, [&] {
        *entry = BlockPool::missing;
        pool.need(team, {rows, 0, 0, 0});
      });
      return;
    }
    const Stash stash(reinterpret_cast<Id*>(begin) + sizes.rows + 1, sizes.rows);
    team::once(team, [&] { shared.overflows = 0; });
    team::for_all(team, rows,
                  [&](Id row) { begin[row] = static_cast<std::uint32_t>(count<Search>(first + row, stash, row)); });
    team::exclusive_scan(team, rows, begin);
    team::for_all(team, rows, [&](Id row) {
      if (begin[row + 1] > most_entries) shared.overflows = 1;  // the first that is too many hasn't wrapped around yet
    });
    team::barrier(team);
    team::once(team, [&] {
      shared.block = shared.overflows ? BlockPool::missing : pool.reserve(team, BlockLayout::words(rows, begin[rows]));
      *entry = shared.overflows ? BlockPool::uncountable : shared.block;
      if (shared.overflows) pool.reserve(team, pool.capacity + 1);  // so that `used` says that something is missing
    });
    team::barrier(team);
    if (shared.block == BlockPool::missing) return;
    Id* const offsets = pool.words + shared.block;
    Id* const ids = offsets + rows + 1;
    team::for_all(team, rows + 1, [&](Id row) { offsets[row] = static_cast<Id>(begin[row]); });
    team::for_all(team, rows, [&](Id row) {
      write<Search>(first + row, stash, row, ids + begin[row], static_cast<Id>(begin[row + 1] - begin[row]));
    });
  }

 private:
  /// Has the mesh vertices of so many simplices that bisection finds a row's entries faster?
  bool bisects() const { return simplices.longest_list > detail::longest_looked_through; }

  template <class Search, class Use>
  void use_at_level(const Use& use) const {
    at_scratch_level<Memory>(scratch_level, [&](auto level) { use(OnTeams<level, Search>{*this}); });
  }

  static constexpr std::uint32_t most_entries = 2147483647;  ///< that an Id counts

  using Stash = detail::RowStash<relation, is_device_memory<Memory>>;

  struct Shared {
    Offset block;
    Offset overflows;  ///< the sum of all counts is no Id
  };

  /// The first simplex of the rows' dimension that begins with a vertex or a later one.
  KOKKOS_FUNCTION Id first_of(Id vertex) const {
    constexpr int dimension = row_dimension(relation);
    if constexpr (dimension == 0) return vertex;
    if constexpr (dimension == 1) return simplices.edge_begin(vertex);
    if constexpr (dimension == 2)
      return simplices.dimension == 2 ? simplices.cell_begin(vertex)
                                      : simplices.triangle_begin(simplices.edge_begin(vertex));
    if constexpr (dimension == 3) return simplices.cell_begin(vertex);
  }

  template <class Search>
  KOKKOS_FUNCTION Id count(Id simplex, const Stash& stash, Id row) const {
    if (stash.capacity() == 0) return detail::count_entries<relation, Search>(simplices, simplex);
    Id entries = 0;
    detail::for_each_entry<relation, Search>(simplices, simplex, [&](Id id) { stash.add(row, entries++, id); });
    return entries;
  }

  template <class Search>
  KOKKOS_FUNCTION void write(Id simplex, const Stash& stash, Id row, Id* out, Id count) const {
    if (count <= stash.capacity()) {
      stash.read(row, count, out);
    } else {
      detail::write_entries<relation, Search>(simplices, simplex, out, count);
    }
  }
};

template <Relation relation, class Memory>
const char* RowKernel<relation, Memory>::label() const {
  static const std::string label = "GALE::" + name_of(relation);
  return label.c_str();
}

}  // namespace gale
