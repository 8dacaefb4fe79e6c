#pragma once

#include <gale/export.hpp>
#include <gale/mesh/mesh.hpp>
#include <gale/relations/relation.hpp>

namespace gale {

/// What of a mesh's simplices whoever looks up or computes rows of these relations reads, where cells have that
/// dimension.
GALE_EXPORT SimplexNeeds needs_of(RelationSet relations, int dimension = 3);

/// Throws gale::Error, naming the first, if meshes of a dimension lack some of these relations.
GALE_EXPORT void require_relations(RelationSet wanted, int dimension);

/// Throws gale::Error, naming the relations and what to do, unless those that a structure was preconditioned for
/// contain `wanted`.
GALE_EXPORT void require_preconditioned(RelationSet preconditioned, RelationSet wanted);

/// Throws gale::Error unless the mesh has a simplex of that dimension and GALE's id.
GALE_EXPORT void require_simplex(const Mesh& mesh, int dimension, Id simplex);

/// Throws gale::Error unless `simplex` is one of `count` simplices of that dimension.
GALE_EXPORT void require_simplex(Id count, int dimension, Id simplex);

}  // namespace gale
