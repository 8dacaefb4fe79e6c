#pragma once

#include <gale/runtime/structure.hpp>
#include <gale/runtime/whole/face_rows.hpp>

namespace gale::detail {

/// A whole relation in one sweep. Each row is written to a place of its own as soon as it is there; when all sizes are
/// known, the rows are moved together in the same memory. So there is one copy of nearly all entries, and pages that
/// are touched once.
Csr<const Id, HostMemory> swept_rows(Structure& structure, Relation relation, const RelationNames& names,
                                     const SweepOptions& options);

}  // namespace gale::detail
