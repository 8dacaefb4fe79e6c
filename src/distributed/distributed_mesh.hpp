#pragma once

#include <limits>
#include <memory>

#include <gale/distributed/communicator.hpp>
#include <gale/distributed/mesh_part.hpp>
#include <gale/export.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale {

namespace detail {
class ExchangePlan;
}

/// How a mesh is shared between ranks.
struct PartitionOptions {
  /// Deal the vertices out along a space-filling curve, as many to each rank. Else each vertex belongs to the lowest
  /// rank that hands it over.
  bool repartition = false;

  int capacity = default_capacity;  ///< vertices of a segment of the octree, at most

  bool keep_corners = false;  ///< have corners(): 16 bytes a tetrahedron

  /// Vertices, and tetrahedra, that one rank may hold: what its local ids, of 32 bits, can number. Less for tests.
  Offset most_local = std::numeric_limits<Id>::max();
};

/// A tetrahedral mesh that lies on several MPI ranks. Each vertex is owned by one rank, which holds every tetrahedron
/// that touches one of its vertices; the other vertices of these are its ghosts. So the star of an owned vertex is
/// complete. Immutable; copies share all.
///
/// Users know vertices and tetrahedra by global ids of 64 bits. Each rank has a `Mesh` of what it holds, the local
/// mesh, whose ids have 32 bits. Its input ids ascend with the global ones; among GALE's, owned vertices come first,
/// and sweeps visit these alone. Results are the same for any number of ranks, and for any partition.
class GALE_EXPORT DistributedMesh {
 public:
  /// From what each rank has. Collective. Time and memory grow with the rank's part; messages are those tetrahedra that
  /// others hold too, and a few words a vertex.
  ///
  /// Throws gale::Error on all ranks, with the global ids at fault and the rank that found it: as Mesh and
  /// octree_segmentation do, for ids below 0 or from 2^62 on, a vertex that no rank hands over, a tetrahedron id that
  /// a rank holds twice, and if a rank would hold more than `most_local`: then it says how many ranks it takes.
  template <class Index>
  DistributedMesh(const Communicator& ranks, const MeshPart<Index>& part, const PartitionOptions& options = {});

  /// The ranks that it lies on.
  const Communicator& ranks() const;

  /// What this rank holds. It may have no tetrahedra, and no vertices.
  const Mesh& local() const;

  /// How many vertices all ranks own together.
  GlobalId vertices() const;

  /// How many tetrahedra all ranks have handed over.
  GlobalId tetrahedra() const;

  /// The global id of a vertex of the local mesh, by its local input id.
  GlobalId vertex_id(Id vertex) const;

  /// The global id of a tetrahedron of the local mesh, by its local input id. Takes O(log n) for n tetrahedra that came
  /// from other ranks.
  GlobalId tetrahedron_id(Id tetrahedron) const;

  /// The local input id of a vertex; no_id if this rank doesn't hold it.
  Id vertex_of(GlobalId id) const;

  /// The global ids of all local vertices, by local input id: ascending. This array and the next three are made by the
  /// first call, on any thread; it throws OutOfMemory where they don't fit.
  const Array<const GlobalId, HostMemory>& vertex_ids() const;

  /// The global ids of all local tetrahedra, by local input id: ascending.
  const Array<const GlobalId, HostMemory>& tetrahedron_ids() const;

  /// The rank that owns each local vertex, by its local input id.
  const Array<const int, HostMemory>& owners() const;

  /// Where each local vertex is, by its local input id.
  const Points<double, HostMemory>& points() const;

  /// The local input ids of each local tetrahedron's vertices, by its local input id, in the order in which they were
  /// handed over. Empty unless `keep_corners`.
  const Tetrahedra<Id, HostMemory>& corners() const;

  /// How many vertices this rank has handed over: a field has a value for each.
  Offset given_vertices() const;

  /// Brings what the ranks know of the vertices that they handed over to those who hold them. For GALE's own
  /// algorithms.
  const detail::ExchangePlan& from_givers() const;

  /// Brings what the ranks know of vertices that they own to those who have them as ghosts. For GALE's own algorithms.
  const detail::ExchangePlan& from_owners() const;

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

}  // namespace gale
