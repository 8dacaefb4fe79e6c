#pragma once

#include <array>
#include <vector>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/distributed/distributed_order.hpp>

namespace gale {

/// Critical simplices by the global ids of their vertices, from the highest to the lowest, and of a tetrahedron its
/// own: those whose highest vertex this rank owns. By dimension they are ordered as those of CriticalSimplices: by ids,
/// written with the vertices ascending.
struct DistributedCriticalSimplices {
  std::vector<GlobalId> vertices;                  ///< minima
  std::vector<std::array<GlobalId, 2>> edges;      ///< 1-saddles
  std::vector<std::array<GlobalId, 3>> triangles;  ///< 2-saddles
  std::vector<GlobalId> tetrahedra;                ///< maxima
};

/// A discrete gradient of a mesh on several ranks: each rank has the pairs of the simplices whose highest vertices it
/// owns.
struct GALE_EXPORT DistributedGradient {
  DistributedMesh mesh;  ///< what it is a gradient of

  /// The gradient of the local mesh. A successor that this rank doesn't know is DiscreteGradient::elsewhere.
  DiscreteGradient local;

  /// How many critical simplices there are on all ranks, by dimension.
  std::array<GlobalId, 4> counts{};

  /// Alternating sum of the counts: the Euler characteristic of the whole mesh.
  GlobalId euler() const { return counts[0] - counts[1] + counts[2] - counts[3]; }

  /// The critical simplices whose highest vertices this rank owns.
  DistributedCriticalSimplices critical() const;
};

/// Finds the discrete gradient of a field on a mesh on several ranks: the same as of the whole mesh on one. `structure`
/// is one of the order's local mesh, preconditioned for discrete_gradient_relations. Collective, but nothing is
/// exchanged beside the counts. Throws gale::Error on all ranks.
GALE_EXPORT DistributedGradient find_discrete_gradient(Structure& structure, const DistributedOrder& order,
                                                       const SweepOptions& options = {});

/// Finds the same gradient by kernels where the relations are made.
GALE_EXPORT DistributedGradient find_discrete_gradient(const WorkerSpace& space, const DistributedOrder& order,
                                                       const DeviceSweepOptions& options = {});

}  // namespace gale
