#pragma once

#include <gale/base/csr.hpp>
#include <gale/export.hpp>
#include <gale/mesh/mesh.hpp>
#include <gale/relations/relation.hpp>
#include <gale/runtime/sweep_options.hpp>

namespace gale {

/// By which ids simplices go: GALE's own, as everywhere in sweeps, or the input's (`input_numbers`).
enum class Ids { gale, input };

/// Makes a relation of the whole mesh on the host: for each simplex of row_dimension(relation), by its id, the ids of
/// those of entry_dimension(relation) that touch it, ascending. Both go by `ids`. The result depends on nothing but the
/// mesh, and stays as it is: nothing else holds it.
///
/// Computed on `options.threads` threads; where the mesh lies on a device, that computes the rows, in its own memory
/// those to faces and from them: 4 bytes an entry, from faces 8, and 8 a row. To be called from any thread, also from
/// several at once where Kokkos has no device; `options.progress` is called on the calling one, for each of the steps
/// that it takes. Time O(n). Takes 8 bytes a row and 4 an entry. Beside these, where the mesh isn't on a device: for EE
/// and FF, and relations to simplices of a higher dimension, the faces of their simplices (4 bytes each) and as much
/// memory as the entries to count in; for Ids::gale 4 bytes a simplex. Simplices are enumerated as far as that takes,
/// and the input's numbers of edges and triangles (4 bytes each) stay with the mesh, where it lies.
///
/// Rows of simplices that have ghosts alone are empty. Throws gale::Error for less than one thread, and as
/// Mesh::simplices does; OutOfMemory where the memory isn't there; Stopped when it is asked to stop (base/stop.hpp).
GALE_EXPORT Csr<const Id, HostMemory> relation_of(const Mesh& mesh, Relation relation, Ids ids,
                                                  const SweepOptions& options = {});

}  // namespace gale
