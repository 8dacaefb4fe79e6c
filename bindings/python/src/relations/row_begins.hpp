#pragma once

#include <gale/base/parallel.hpp>

#include "whole_relation.hpp"

namespace gale::python {

/// Sets where rows begin, of which there are size(row) entries each; returns how many entries there are. Asks for each
/// size once.
template <class Size>
std::int64_t set_begins(const WholeRelation& all, const Size& size) {
  const Kokkos::View<std::int64_t*, HostMemory> begin(all.begin.get(), all.rows + std::size_t(1));
  parallel_for("GALE::row_size", HostExecutionSpace(), all.rows, [&](Offset row) { begin(row) = size(row); });
  return exclusive_scan("GALE::row_begin", HostExecutionSpace(), all.rows, begin,
                        [&](Offset row) { return begin(row); });
}

}  // namespace gale::python
