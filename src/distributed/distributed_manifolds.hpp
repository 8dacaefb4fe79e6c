#pragma once

#include <gale/distributed/distributed_gradient.hpp>

namespace gale {

/// The manifolds of a gradient on a mesh on several ranks, for each vertex that a rank holds, ghosts too, by local
/// input id. Minima, maxima and pairs have the same numbers as those of the whole mesh on one rank.
struct DistributedManifolds {
  /// The place of the minimum that the vertex's path falls to, among the critical vertices of all ranks, by global id.
  Array<const GlobalId, HostMemory> descending;

  /// The place of the maximum that the path from the vertex's tetrahedron of lowest global id rises to, likewise; -1 if
  /// that path leaves through the surface, or the vertex has no tetrahedron.
  Array<const GlobalId, HostMemory> ascending;

  /// A number for each pair (ascending, descending) that occurs, in lexicographic order, dense from 0; -1 where the
  /// ascending one is missing.
  Array<const GlobalId, HostMemory> morse_smale;
  GlobalId morse_smale_manifolds = 0;  ///< how many pairs there are

  int rounds = 0;  ///< how many rounds of messages paths took from rank to rank
};

/// Finds the manifolds of a gradient by pointer jumping on each rank, then from rank to rank. Collective; throws
/// gale::Error on all ranks. 12 bytes a tetrahedron and 60 a vertex beside the gradient.
GALE_EXPORT DistributedManifolds find_manifolds(const DistributedGradient& gradient);

}  // namespace gale
