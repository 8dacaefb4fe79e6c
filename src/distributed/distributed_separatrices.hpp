#pragma once

#include <array>
#include <vector>

#include <gale/distributed/distributed_gradient.hpp>

namespace gale {

/// Paths along the gradient of a mesh on several ranks, from one critical simplex to another, with where they lead:
/// those whose source this rank has among its critical simplices. The i-th is cells[begin[i]] to cells[begin[i + 1] -
/// 1]. Numbers are those of the whole mesh on one rank.
struct DistributedSeparatrices {
  std::vector<GlobalId> sources;              ///< the place of the source among the critical simplices of all ranks
  std::vector<Id> sources_here;               ///< and among those of this rank
  std::vector<GlobalId> destinations;         ///< the place of the last simplex among those of all ranks
  std::vector<Offset> begin{0};               ///< where each path's cells begin, and the end of the last
  std::vector<GlobalId> cells;                ///< global ids of vertices, or of tetrahedra
  std::vector<std::array<double, 3>> points;  ///< where each cell is: the vertex, or the tetrahedron's barycentre

  /// What precedes each cell: before the first of a path the source, else the simplex that it shares with the one
  /// before. The global ids of its vertices, ascending; of an edge the third is -1.
  std::vector<std::array<GlobalId, 3>> between;
  std::vector<std::array<double, 3>> between_points;  ///< an edge's middle, or a triangle's incentre

  /// How many paths there are.
  Offset count() const { return static_cast<Offset>(sources.size()); }
};

/// Finds the separatrices from each critical edge down to minima, one from each of its vertices, that of lower global
/// id first: the vertices on the way. Collective, as all here; a number of rounds of messages that grows with the
/// logarithm of how often a path changes ranks. Throws gale::Error on all ranks.
GALE_EXPORT DistributedSeparatrices find_descending_separatrices(const DistributedGradient& gradient);

/// Finds the separatrices from each critical triangle up to maxima, one from each of its tetrahedra, by global id: the
/// tetrahedra on the way. Those that leave through the mesh's surface are left out.
GALE_EXPORT DistributedSeparatrices find_ascending_separatrices(const DistributedGradient& gradient);

}  // namespace gale
