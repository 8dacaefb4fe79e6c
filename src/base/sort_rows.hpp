#pragma once

#include <gale/base/memory.hpp>
#include <gale/base/types.hpp>

namespace gale {

/// Sorts each row [begin[r], begin[r+1]) of `values` ascending, rows in parallel. Rows that are in order already cost
/// one reading. `Index` is Id or Offset. Enqueued on the instance of a device, as loops are.
template <class Space, class Index>
void sort_rows(const Space& space, const char* label, const Array<Index, MemoryOf<Space>>& begin,
               const Array<Id, MemoryOf<Space>>& values);

}  // namespace gale
