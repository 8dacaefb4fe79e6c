#pragma once

#include <limits>
#include <memory>
#include <utility>

#include <gale/distributed/communicator.hpp>
#include <gale/distributed/grid_layers.hpp>
#include <gale/distributed/mesh_part.hpp>
#include <gale/export.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale {

/// How a mesh is shared between ranks.
struct PartitionOptions {
  /// Deal the vertices out along a space-filling curve, as many to each rank. Else each vertex belongs to the lowest
  /// rank that hands it over.
  bool repartition = false;

  int capacity = default_capacity;  ///< vertices of a segment of the octree, at most

  bool keep_corners = false;  ///< have corners(): 16 bytes a tetrahedron, 12 a triangle

  /// Vertices, and cells, that one rank may hold: what its local ids, of 32 bits, can number. Less for tests.
  Offset most_local = std::numeric_limits<Id>::max();
};

/// One rank's part of a mesh of tetrahedra, or of triangles, that lies on several MPI ranks. Each vertex is owned by
/// one rank, which holds every cell that touches one of its vertices; the other vertices of these are its ghosts. So
/// the star of an owned vertex is complete. Immutable; copies share all.
///
/// Users know vertices and cells by global ids of 64 bits. As a `Mesh` it has what this rank holds, which may be no
/// cells, and no vertices, under ids of 32 bits. Its input ids ascend with the global ones; among GALE's, owned
/// vertices come first, and sweeps visit these alone. Algorithms have the same results for any number of ranks, and for
/// any partition; a field has a value for each vertex that this rank has handed over, in that order. What takes such a
/// mesh is collective, and throws gale::Error on all ranks if it fails on one.
class GALE_EXPORT DistributedMesh : public Mesh {
 public:
  /// From what each rank has. Collective. Time and memory grow with the rank's part; messages are those cells that
  /// others hold too, and a few words a vertex.
  ///
  /// Throws gale::Error on all ranks, with the global ids at fault and the rank that found it: as Mesh and
  /// octree_segmentation do, for ids below 0 or from 2^62 on, a vertex that no rank hands over, a cell id that a rank
  /// holds twice, triangles of one rank and tetrahedra of another, and if a rank would hold more than `most_local`:
  /// then it says how many ranks it takes.
  template <class Index>
  DistributedMesh(const Communicator& ranks, const MeshPart<Index>& part, const PartitionOptions& options = {})
      : DistributedMesh(shared(ranks, part, options)) {}

  /// From the layers of a grid that each rank has, which it owns: local meshes are grids, and no cells are written out.
  /// Collective. Nothing is dealt out again, whatever `repartition` says. Throws gale::Error on all ranks where layers
  /// don't fit together, a vertex has no cube, there is no cube, and if a rank would hold more than `most_local`.
  DistributedMesh(const Communicator& ranks, const GridLayers& part, const PartitionOptions& options = {})
      : DistributedMesh(shared(ranks, part, options)) {}

  /// The global ids of the vertices that this rank holds, by input id: ascending. This array and the next three are
  /// made by the first call, on any thread; it throws OutOfMemory where they don't fit.
  const Array<const GlobalId, HostMemory>& vertex_ids() const;

  /// The global ids of the cells that it holds, by input id: ascending.
  const Array<const GlobalId, HostMemory>& cell_ids() const;

  /// The rank that owns each of these vertices, by input id.
  const Array<const int, HostMemory>& owners() const;

  /// Where each of these vertices is, by input id; empty where layers of a grid were handed over without.
  const Points<double, HostMemory>& points() const;

  /// The input ids of each cell's vertices, by its input id, in the order in which they were handed over. Empty unless
  /// `keep_corners`.
  const CellRows<Id>& corners() const;

 private:
  class Sharing;
  using Shared = std::pair<Mesh, std::shared_ptr<const Sharing>>;

  explicit DistributedMesh(const Shared& all) : Mesh(all.first), sharing_(all.second) {}

  template <class Part>
  static Shared shared(const Communicator& ranks, const Part& part, const PartitionOptions& options);

  std::shared_ptr<const Sharing> sharing_;
};

}  // namespace gale
