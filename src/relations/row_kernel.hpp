#pragma once

#include <string>

#include <gale/base/team.hpp>
#include <gale/mesh/simplices.hpp>
#include <gale/relations/block_pool.hpp>
#include <gale/relations/detail/ranking.hpp>
#include <gale/relations/detail/row_entries.hpp>
#include <gale/relations/rows.hpp>

namespace gale {

/// Computes one relation other than VV, VT and link for one segment a team: the rows of the simplices that are internal to it, compact and
/// ascending.
///
///     a lane a row: count its entries
///     scan; reserve the block
///     a lane a row: write them
///
/// A segment of more rows than `sizes` says, or for whose block the pool has no room, is left out, as StarKernel does.
template <Relation relation, class Memory>
class RowKernel {
 public:
  Simplices<Memory> simplices;
  Kokkos::View<const Id*, Memory, Kokkos::MemoryUnmanaged> vertex_begin;  ///< I_V
  const Id* segments = nullptr;                                          ///< of the batch, one a team
  StarSizes sizes;                                                       ///< rows alone count
  int scratch_level = 0;
  BlockPool pool;

  const char* label() const;

  static std::size_t scratch_bytes(const StarSizes& sizes, int /*warps*/) { return sizeof(Shared) + (std::size_t(sizes.rows) + 1) * sizeof(Id); }

  template <class Team>
  KOKKOS_FUNCTION void operator()(const Team& team) const {
    char* const memory = team::scratch(team, scratch_level, sizeof(Shared) + (std::size_t(sizes.rows) + 1) * sizeof(Id));
    Shared& shared = *reinterpret_cast<Shared*>(memory);
    Id* const begin = reinterpret_cast<Id*>(memory + sizeof(Shared));
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
    team::for_all(team, rows, [&](Id row) { begin[row] = detail::count_entries<relation>(simplices, first + row); });
    team::exclusive_scan(team, rows, begin);
    team::once(team, [&] { *entry = shared.block = pool.reserve(team, BlockLayout::words(rows, begin[rows])); });
    team::barrier(team);
    if (shared.block == BlockPool::missing) return;
    Id* const offsets = pool.words + shared.block;
    Id* const ids = offsets + rows + 1;
    team::for_all(team, rows + 1, [&](Id row) { offsets[row] = begin[row]; });
    team::for_all(team, rows, [&](Id row) { write_row(first + row, ids + begin[row], begin[row + 1] - begin[row]); });
  }

 private:
  struct Shared {
    Offset block;
    Offset padding;
  };

  /// The first simplex of the rows' dimension that begins with a vertex or a later one.
  KOKKOS_FUNCTION Id first_of(Id vertex) const {
    constexpr int dimension = row_dimension(relation);
    if constexpr (dimension == 0) return vertex;
    if constexpr (dimension == 1) return simplices.edge_begin(vertex);
    if constexpr (dimension == 2) return simplices.triangle_begin(simplices.edge_begin(vertex));
    if constexpr (dimension == 3) return simplices.tetrahedron_begin(vertex);
  }

  KOKKOS_FUNCTION void write_row(Id simplex, Id* row, Id count) const {
    Id* next = row;
    if constexpr (detail::visits_in_order(relation)) {
      detail::for_each_entry<relation>(simplices, simplex, [&](Id id) { *next++ = id; });
    } else if (count <= few) {
      Id ids[few];
      Id placed = 0;
      detail::for_each_entry<relation>(simplices, simplex, [&](Id id) {
        Id at = placed++;
        for (; at > 0 && ids[at - 1] > id; --at) ids[at] = ids[at - 1];
        ids[at] = id;
      });
      for (Id i = 0; i < count; ++i) row[i] = ids[i];
    } else {
      detail::for_each_entry<relation>(simplices, simplex, [&](Id id) { *next++ = id; });
      detail::heap_sort(row, count);
    }
  }

  /// So many entries are put in order in a lane's own memory.
  static constexpr Id few = 32;
};

template <Relation relation, class Memory>
const char* RowKernel<relation, Memory>::label() const {
  static const std::string label = "GALE::" + name_of(relation);
  return label.c_str();
}

}  // namespace gale
