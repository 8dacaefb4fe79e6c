#pragma once

#include <gale/base/csr.hpp>
#include <gale/base/types.hpp>

namespace gale {

/// Sorts the entries of each row ascending, rows in parallel. Rows that are in order already cost one reading. `Index`
/// is Id or Offset. Enqueued on the instance of a device, as loops are.
template <class Space, class Index>
void sort_rows(const Space& space, const char* label, const Csr<Id, MemoryOf<Space>, Index>& rows);

}  // namespace gale
