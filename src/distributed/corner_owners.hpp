#pragma once

#include <string>
#include <vector>

#include <gale/distributed/distributed_mesh.hpp>
#include <gale/distributed/vertex_directory.hpp>

namespace gale::detail {

/// The tetrahedra of a part with vertices outside `own`: their places in it, ascending. Throws gale::Error for one of
/// these whose vertices are below 0 or not different.
template <class Index>
std::vector<Id> tetrahedra_beyond(const MeshPart<Index>& part, const IdInterval& own);

/// Throws gale::Error for the first tetrahedron whose vertices are below 0 or not different.
template <class Index>
void require_tetrahedra(const MeshPart<Index>& part);

/// The ranks that own the vertices of some tetrahedra of a part.
template <class Index>
class CornerOwners {
 public:
  /// Takes the `outer` ones: the others have vertices in `own` alone. Collective. Throws gale::Error on all ranks for a
  /// vertex that no rank hands over.
  CornerOwners(const Communicator& ranks, const MeshPart<Index>& part, const VertexDirectory& directory,
               const IdInterval& own, const std::vector<Id>& outer);

  /// Calls visit(rank) once for each rank that owns a vertex of a tetrahedron.
  template <class Visit>
  void visit_ranks(Offset t, const Visit& visit) const {
    int ranks[4];
    for (int corner = 0; corner < 4; ++corner) {
      ranks[corner] = owner(part_.tetrahedra(t, corner));
      bool is_new = true;
      for (int other = 0; other < corner; ++other) is_new &= ranks[other] != ranks[corner];
      if (is_new) visit(ranks[corner]);
    }
  }

 private:
  int owner(GlobalId vertex) const {
    if (own_.contains(vertex)) return rank_;
    const Id place = given_.find(vertex);
    return place != no_id ? of_given_(place).owner : of_others_(others_.find(vertex)).owner;
  }
  void refuse_unknown() const;

  int rank_;
  const MeshPart<Index>& part_;
  const IdInterval own_;
  GlobalIndex given_;   ///< vertices that this rank hands over, where `own` is empty
  GlobalIndex others_;  ///< those that the tetrahedra have beside these
  Array<VertexEntry, HostMemory> of_given_, of_others_;
};

}  // namespace gale::detail
