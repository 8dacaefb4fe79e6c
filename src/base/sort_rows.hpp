#pragma once

#include <gale/base/memory.hpp>
#include <gale/base/types.hpp>

namespace gale {

/// Sorts each row [begin[r], begin[r+1]) of `values` ascending, rows in parallel. Rows that are in order already cost
/// one reading. `Index` is Id or Offset.
template <class Index>
void sort_rows(const char* label, const Array<Index, WorkerMemory>& begin, const Array<Id, WorkerMemory>& values);

}  // namespace gale
