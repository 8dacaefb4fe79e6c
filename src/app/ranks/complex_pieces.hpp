#pragma once

#include <vector>

#include <gale/algorithms/morse_smale.hpp>
#include <gale/app/ranks/rank_session.hpp>
#include <gale/distributed/distributed_gradient.hpp>
#include <gale/distributed/distributed_manifolds.hpp>
#include <gale/distributed/distributed_numbers.hpp>
#include <gale/distributed/distributed_separatrices.hpp>
#include <gale/outputs/critical_simplices.hpp>

// What one rank writes of a complex: with the arrays that outputs/ gives the whole, but that ids have 64 bits. All
// pieces together are what one rank alone writes.

namespace gale::app {

/// The critical edges and triangles of this rank, then those along separatrices.
DistributedNamedSimplices named_simplices(const DistributedGradient& gradient);
void append(const DistributedSeparatrices& descending, const DistributedSeparatrices& ascending,
            DistributedNamedSimplices& named);

/// This rank's critical simplices, with local input ids and no CellIds.
outputs::KnownSimplices known_simplices(const DistributedGradient& gradient, const DistributedNumbers& numbers);

/// The critical simplices as points. `numbers` begin with those of named_simplices(gradient).
io::PointSet to_point_set(const FieldOnRanks& on, const DistributedGradient& gradient,
                          const DistributedNumbers& numbers);

/// ManifoldSize of these. Those of minima, or of maxima, are -1 where they aren't wanted. Collective.
io::PointArray manifold_sizes(const DistributedGradient& gradient, const DistributedManifolds& manifolds,
                              const MorseSmaleParts& wanted);

/// The separatrices as lines. `numbers` are those of named_simplices and append. Collective.
io::Surface separatrices1(const FieldOnRanks& on, const DistributedGradient& gradient,
                          const DistributedSeparatrices& descending, const DistributedSeparatrices& ascending,
                          const DistributedNumbers& numbers);

/// The tetrahedra whose highest vertices this rank owns, with their vertices and all others that it owns; the wanted
/// manifolds; vtkGhostType, which is 1 (a duplicate) for vertices of other ranks; and global ids of vertices and
/// tetrahedra.
io::MeshPiece segmentation(const FieldOnRanks& on, const DistributedManifolds& manifolds,
                           const MorseSmaleParts& wanted);

}  // namespace gale::app
