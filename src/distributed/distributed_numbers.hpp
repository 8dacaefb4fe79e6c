#pragma once

#include <array>
#include <vector>

#include <gale/algorithms/simplex_numbers.hpp>
#include <gale/distributed/distributed_mesh.hpp>

namespace gale {

/// Edges and triangles of a mesh on several ranks, named by the global ids of their vertices, in any order. The same
/// one may occur more than once, and any rank may name any.
struct DistributedNamedSimplices {
  std::vector<std::array<GlobalId, 2>> edges;      ///< two vertices each
  std::vector<std::array<GlobalId, 3>> triangles;  ///< three vertices each
};

/// The numbers by which users know them.
struct DistributedNumbers {
  std::vector<GlobalId> edges;      ///< in the order in which they were asked for
  std::vector<GlobalId> triangles;  ///< in the order in which they were asked for

  /// For each vertex that this rank owns (GALE's id of the local mesh) 1 if it is on the surface of the whole mesh.
  Array<const std::uint8_t, HostMemory> on_surface;
};

/// The place of each simplex that this rank names among all edges, or triangles, of all ranks: what number_simplices
/// finds of the whole mesh on one rank. `structure` is one of the local mesh, preconditioned for
/// simplex_numbers_relations. Collective: a sweep of the owned vertices, and a few rounds of messages, of 16 bytes a
/// vertex and 40 a simplex. Throws gale::Error on all ranks.
GALE_EXPORT DistributedNumbers number_simplices(Structure& structure, const DistributedMesh& mesh,
                                                const DistributedNamedSimplices& named,
                                                const SweepOptions& options = {});

}  // namespace gale
