#pragma once

#include <gale/runtime/structure.hpp>

#include "whole_relation.hpp"

namespace gale::python {

/// A whole relation in one sweep. Each row is written to a place of its own as soon as it is there; when all sizes are
/// known, the rows are moved together in the same memory. So there is one copy of nearly all entries, and pages that
/// are touched once.
WholeRelation rows_in_slots(Structure& structure, Relation relation, const Numbers& numbers,
                            const SweepOptions& options);

}  // namespace gale::python
