#pragma once

#include "support/brute_force.hpp"
#include "support/every_mesh.hpp"

namespace gale::test {

/// A test of all relations, or of some, on each mesh and each segmentation, but on no mesh whose rows of EE and FF have
/// millions of entries.
class EveryRelationMesh : public EveryMesh {
 protected:
  explicit EveryRelationMesh(RelationSet relations = (all_relations | link_form))
      : mesh(fresh_mesh()), expected(input(), brute_force_of(mesh_name()), mesh, relations) {}

  /// A mesh of which nothing was enumerated yet.
  Mesh fresh_mesh() const { return encode(input(), segmentation()); }

  const Mesh mesh;
  const ExpectedRows expected;
};

inline auto every_relation_mesh_and_segmentation() {
  std::vector<std::string> names;
  for (const auto& name : mesh_names()) {
    if (name != "cone_over_sphere_2000") names.push_back(name);
  }
  return testing::Combine(testing::ValuesIn(names), testing::ValuesIn(segmentation_names()));
}

}  // namespace gale::test
