#pragma once

#include <string>

#include <gale/base/csr.hpp>
#include <gale/relations/relation.hpp>

// What Kokkos-Kernels computes, in the workers' space.

namespace gale::detail {

/// Throws gale::Error where GALE was built without Kokkos-Kernels. So do the two that follow.
void require_kokkos_kernels();

/// The coboundary XY from its faces YX: its transpose. Rows ascend. `rows`: how many X there are.
Csr<const Id, WorkerMemory> transpose(Relation relation, const Csr<const Id, WorkerMemory>& faces, Id rows);

/// The adjacency XX from XY and YX: which X share a Y, none of them with itself. Rows ascend. While it works it takes 4
/// bytes an entry, 16 a row and what Kokkos-Kernels hashes with beside the result. Throws gale::Error if it has more
/// entries than an Id counts, before it takes memory for them.
Csr<const Id, WorkerMemory> neighbours(Relation relation, const Csr<const Id, WorkerMemory>& xy,
                                       const Csr<const Id, WorkerMemory>& yx);

/// "GALE::VV": what kernels and arrays of a relation are called.
std::string label_of(Relation relation);

/// Throws gale::Error, naming both, if a relation's entries are more than an Id counts.
void require_countable(Relation relation, Offset entries);

}  // namespace gale::detail
