#pragma once

#include <gale/mesh/mesh.hpp>
#include <gale/relations/relation.hpp>

namespace gale {

/// What of a mesh' simplices whoever looks up or computes rows of these relations reads.
SimplexNeeds needs_of(RelationSet relations);

/// Throws gale::Error, naming the relations and what to do, unless those that a structure was preconditioned for
/// contain `wanted`.
void require_preconditioned(RelationSet preconditioned, RelationSet wanted);

/// Throws gale::Error unless `simplex` is one of the mesh' of that dimension.
void require_simplex(const Mesh& mesh, int dimension, Id simplex);

/// Likewise where the number of them is known.
void require_simplex(Id count, int dimension, Id simplex);

}  // namespace gale
