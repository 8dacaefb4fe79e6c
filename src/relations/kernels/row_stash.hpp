#pragma once

#include <gale/relations/kernels/row_entries.hpp>

namespace gale::detail {

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

}  // namespace gale::detail
