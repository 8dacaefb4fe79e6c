#pragma once

#include <gale/runtime/sweep_options.hpp>
#include <gale/runtime/whole/even_rows.hpp>

// Relations of a whole mesh from those to faces, on the host.

namespace gale::detail {

/// The relation the other way round: for each of so many faces the simplices that have it. Each thread counts and
/// places those of a part of the simplices, so that they ascend. Beside the result it takes 4 bytes for each face from
/// the least to the greatest of a part; there are so few parts that this is no more than twice the entries' memory.
Csr<const Id, HostMemory> transposed_rows(const EvenRows<HostMemory>& faces, Id face_count, int threads);

/// The simplices that share a face with each: those that `cofaces` has for its two or three faces, without itself. Two
/// share one face at most.
Csr<const Id, HostMemory> joined_rows(const EvenRows<HostMemory>& faces, const Csr<const Id, HostMemory>& cofaces,
                                      const SweepOptions& options);

}  // namespace gale::detail
