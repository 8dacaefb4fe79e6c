#pragma once

#include <gale/distributed/distributed_mesh.hpp>
#include <gale/distributed/vertex_directory.hpp>

namespace gale::detail {

/// A tetrahedron on its way to another rank.
struct SentTetrahedron {
  GlobalId id;
  GlobalId vertices[4];
};

/// The tetrahedra that touch a vertex which this rank owns: those of its own part where they are, and those that it
/// got.
template <class Index>
class LocalTetrahedra {
 public:
  /// Sends each tetrahedron to the ranks that own a vertex of it. Collective. Throws gale::Error as DistributedMesh
  /// says. Refers to `part`.
  LocalTetrahedra(const Communicator& ranks, const MeshPart<Index>& part, const VertexDirectory& directory,
                  Offset most_local);

  /// Their global ids, ascending.
  const GlobalIds& ids() const { return sorted_.ids; }
  Offset count() const { return sorted_.ids.extent(0); }

  /// Global id of a vertex of the i-th.
  GlobalId vertex(Offset i, int corner) const {
    const Id place = sorted_.places(i);
    const Id received = place - static_cast<Id>(kept_.extent(0));
    return received < 0 ? GlobalId(part_.tetrahedra(kept_(place), corner))
                        : received_.entries(received).vertices[corner];
  }

  /// The vertices that they have and `owned` lacks, ascending.
  GlobalIds vertices_beside(const GlobalIndex& owned) const {
    return missing_ids(owned, count(), [&](Offset i, const auto& offer) {
      for (int corner = 0; corner < 4; ++corner) offer(vertex(i, corner));
    });
  }

 private:
  void sort(GlobalId first_id);

  const MeshPart<Index>& part_;
  Array<Id, HostMemory> kept_;  ///< places in the part
  Dealt<SentTetrahedron> received_;
  DistinctIds sorted_;  ///< ids, and places among the kept ones, then the received ones
};

/// Throws gale::Error on all ranks if one would hold more than `most` of what `name` says, e.g. "tetrahedra": it says
/// how many ranks it takes. Collective.
void require_local(const Communicator& ranks, const char* name, Offset count, Offset most);

}  // namespace gale::detail
