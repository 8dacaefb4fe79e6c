#pragma once

#include <gale/mesh/mesh.hpp>
#include <gale/relations/relation.hpp>
#include <gale/relations/rows.hpp>

namespace gale::detail {

/// The rows of all vertices, on the host.
struct GlobalRows {
  Array<Id, HostMemory> offsets;  ///< vertices + 1
  Array<Id, HostMemory> ids;

  Rows rows() const { return {0, offsets.data(), ids.data()}; }
};

struct GlobalStars {
  GlobalRows vt;
  GlobalRows vv;  ///< empty unless wanted
};

/// VT of the whole mesh: the transpose of the graph TV; and VV: the symbolic product VT TV without its diagonal. By
/// Kokkos-Kernels, in the producers' space. Throws gale::Error if a relation has more entries than an Id counts, before
/// it takes memory for them; and where GALE was built without Kokkos-Kernels.
GlobalStars global_stars(const Mesh& mesh, bool with_vv);

/// Throws gale::Error, naming both, if a relation's entries are more than an Id counts.
void require_countable(Relation relation, Offset entries);

}  // namespace gale::detail
