#pragma once

#include <gale/runtime/leaders/leader.hpp>
#include <gale/runtime/structure_options.hpp>

namespace gale::detail {

/// The leaders of a structure, one a queue. Consumers share it, so that one that the structure's end surprises finds
/// everything in place.
class Leaders {
 public:
  /// Where the mesh is on a device, its workers are there too.
  Leaders(const Mesh& mesh, RelationSet relations, const StructureOptions& options);

  const Mesh& mesh() const { return mesh_; }
  RelationSet relations() const { return relations_; }
  const std::vector<std::unique_ptr<Leader>>& all() const { return leaders_; }

  /// The leader of one relation, or of the links. There is one, unless it is a face relation.
  Leader& of(RelationSet one) const;

  /// The leaders that have some of the relations wanted.
  std::vector<Leader*> some_of(RelationSet wanted) const;

  /// Fails all requests, and returns when their consumers have gone.
  void end();

 private:
  const Mesh mesh_;
  const RelationSet relations_;
  std::vector<std::unique_ptr<Leader>> leaders_;
};

}  // namespace gale::detail
