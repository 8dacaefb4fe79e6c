#include <algorithm>
#include <string>

#include <gale/base/error.hpp>
#include <gale/relations/preconditioning.hpp>
#include <gale/relations/relation.hpp>

namespace gale {

std::string name_of(Relation relation) { return traits_of(relation).name; }

std::optional<Relation> relation_named(const std::string& name) {
  for (const Relation relation : members_of(all_relations)) {
    if (name_of(relation) == name) return relation;
  }
  return std::nullopt;
}

std::vector<Relation> members_of(RelationSet relations) {
  std::vector<Relation> members;
  for (int i = 0; i < relation_count; ++i) {
    if (relations.has(static_cast<Relation>(i))) members.push_back(static_cast<Relation>(i));
  }
  return members;
}

std::string name_of(RelationSet relations) {
  std::string names;
  const auto add = [&names](const std::string& name) { names += (names.empty() ? "" : ", ") + name; };
  for (const Relation relation : members_of(relations)) add(name_of(relation));
  if (relations.has_links()) add("link");
  return names;
}

SimplexNeeds needs_of(RelationSet relations, int dimension) {
  SimplexNeeds needs;
  needs.triangle_edge = false;
  for (const Relation relation : members_of(relations)) {
    SimplexNeeds one = traits_of(relation).needs;
    // Where triangles are cells, nothing but these is read.
    const bool from_cells = dimension == 2 && (relation == Relation::VF || relation == Relation::FV);
    if (from_cells) one = traits_of(relation == Relation::VF ? Relation::VT : Relation::TV).needs;
    needs.upto = std::max(needs.upto, one.upto);
    needs.lower_edges |= one.lower_edges;
    needs.cells |= one.cells;
    needs.triangle_edge |=
        row_dimension(relation) == 2 && !from_cells;  // whose rows begin with the triangle's vertices
  }
  return needs;
}

void require_preconditioned(RelationSet preconditioned, RelationSet wanted) {
  if (preconditioned.contains(wanted)) return;
  throw Error("the structure was preconditioned for " +
              (preconditioned.empty() ? "no relation" : name_of(preconditioned)) + ", not for " +
              name_of(wanted - preconditioned) + ": name every relation that you read when you construct it");
}

void require_relations(RelationSet wanted, int dimension) {
  const RelationSet missing = wanted - relations_of_dimension(dimension) - link_form;
  if (missing.empty()) return;
  throw Error("a mesh of triangles has no relation " + name_of(members_of(missing).front()) +
              ": it has those among vertices, edges and triangles");
}

void require_simplex(const Mesh& mesh, int dimension, Id simplex) {
  require_simplex(mesh.interval_begin(dimension)(mesh.segments()), dimension, simplex);
}

void require_simplex(Id count, int dimension, Id simplex) {
  static const char* const names[] = {"vertex", "edge", "triangle", "tetrahedron"};
  if (simplex >= 0 && simplex < count) return;
  throw Error("there is no " + std::string(names[dimension]) + ' ' + std::to_string(simplex) + ": the mesh has 0 to " +
              std::to_string(count - 1));
}

}  // namespace gale
