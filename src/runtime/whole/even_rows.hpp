#pragma once

#include <gale/base/csr.hpp>
#include <gale/base/parallel.hpp>

namespace gale::detail {

/// A relation to faces, all of whose rows have as many entries: row i is entries(length * i) to
/// entries(length * (i + 1) - 1). It has no offsets, which would take 8 bytes a row.
template <class Memory>
struct EvenRows {
  int length = 0;
  Array<const Id, Memory> entries;

  const Id* row(Offset i) const { return entries.data() + length * i; }
  Id rows() const { return length == 0 ? 0 : static_cast<Id>(entries.extent(0) / length); }
};

template <class Offsets>
struct WriteEvenOffset {
  Offsets offsets;
  int length;
  KOKKOS_FUNCTION void operator()(Offset i) const {
    offsets(i) = static_cast<typename Offsets::value_type>(length * i);
  }
};

/// Adds the offsets, on `space`, which works in that memory.
template <class Index = Offset, class Space, class Memory>
Csr<const Id, Memory, Index> with_offsets(const Space& space, const EvenRows<Memory>& even) {
  const auto offsets = allocate<Array<Index, Memory>>("GALE::row_begin", even.rows() + Offset(1));
  parallel_for("GALE::row_begin", space, even.rows() + Offset(1),
               WriteEvenOffset<Array<Index, Memory>>{offsets, even.length});
  return {offsets, even.entries};
}

}  // namespace gale::detail
