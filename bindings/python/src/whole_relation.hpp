#pragma once

#include <cstdint>
#include <memory>

#include <gale/runtime/structure.hpp>

namespace gale::python {

/// All rows of a relation, in the numbers of the input.
struct WholeRelation {
  std::shared_ptr<std::int64_t[]> begin;  ///< where each row begins, and the last one ends
  std::shared_ptr<Id> entries;            ///< ascending in each row
  Id rows = 0, columns = 0;               ///< how many simplices have rows, and may be entries
};

/// Computes it in one sweep. `row_number` and `entry_number` lead from GALE's ids to the input's numbers. Each row is
/// written to a place of its own as soon as it is there; when all sizes are known, the rows are moved together in the
/// same memory. So there is one copy of nearly all entries, and pages that are touched once.
WholeRelation whole_relation(Structure& structure, Relation relation, const Id* row_number, const Id* entry_number,
                             const SweepOptions& options);

}  // namespace gale::python
