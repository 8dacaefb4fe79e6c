#include <gale/relations/structure.hpp>

#include <gale/base/error.hpp>

namespace gale {

void require_preconditioned(RelationSet preconditioned, RelationSet wanted) {
  if (preconditioned.contains(wanted)) return;
  throw Error("the structure was preconditioned for " + (preconditioned.empty() ? "no relation" : name_of(preconditioned)) + ", not for " +
              name_of(wanted) + ": name every relation that you read when you construct it");
}

void require_vertex(const Mesh& mesh, Id vertex) {
  if (vertex >= 0 && vertex < mesh.vertices()) return;
  throw Error("there is no vertex " + std::to_string(vertex) + ": the mesh has 0 to " + std::to_string(mesh.vertices() - 1));
}

}  // namespace gale
