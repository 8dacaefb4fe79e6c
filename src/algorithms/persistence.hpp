#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/export.hpp>

namespace gale {

/// Two critical simplices, `upper` one dimension higher than `lower`: their places in CriticalSimplices. `lower` begins
/// a class of homology when the mesh is built up along the field, `upper` ends it.
struct PersistencePair {
  Id lower;  ///< place among the critical simplices of the lower dimension
  Id upper;  ///< place among those of the next

  /// Compares both simplices.
  friend bool operator==(const PersistencePair& a, const PersistencePair& b) {
    return a.lower == b.lower && a.upper == b.upper;
  }
};

/// The persistent homology of a field, over Z2: each critical simplex is in one pair or essential.
struct PersistencePairs {
  /// By the dimension of the lower simplex: minimum and 1-saddle, 1-saddle and 2-saddle, 2-saddle and maximum. On a
  /// triangle mesh: minimum and saddle, saddle and maximum, and none of the third kind. In the order of the lower
  /// simplices.
  std::array<std::vector<PersistencePair>, 3> pairs;

  /// By dimension, the simplices whose classes never end, ascending: as many as the mesh's Betti number.
  std::array<std::vector<Id>, 4> essential;
};

/// The pairs of a gradient's critical simplices: those of the lower-star filtration of its order, in which the
/// simplices of one dimension with the same highest vertex come in the order of their other vertices, from the highest
/// to the lowest. So they depend on nothing but mesh and order.
///
/// From the gradient alone: no edge or triangle is enumerated. The ends of 1-separatrices are joined from the lowest
/// 1-saddle up, and from the highest 2-saddle down, where the outside of the mesh is older than any maximum. The rims
/// of the other 2-saddles fall along the gradient until they meet a 1-saddle (Guillou, Vidal, Tierny, "Discrete Morse
/// Sandwich", 2023). On a triangle mesh the ends of all saddles are joined so. On options.threads threads;
/// options.progress isn't called. Memory beside the result: 100 bytes a critical simplex, and 8 for each edge of a rim
/// that met a 1-saddle.
GALE_EXPORT PersistencePairs find_persistence_pairs(const DiscreteGradient& gradient, const SweepOptions& options = {});

/// The highest vertices of critical simplices, which have their values: input ids of a mesh.
struct HighestVertices {
  int dimension = 3;                           ///< the mesh's
  std::array<std::vector<Id>, 4> of_critical;  ///< by dimension, and place in CriticalSimplices
  Id of_all = no_id;                           ///< the mesh's highest vertex, no_id if it has none
};

/// The highest vertices of a gradient's critical simplices.
GALE_EXPORT HighestVertices highest_vertices(const DiscreteGradient& gradient);

/// Persistence pairs of a field that lies on several ranks: on the first of them; on the others there are none.
struct GatheredPairs {
  Mesh mesh;                ///< vertices alone, with their global ids (`vertex_id`); on one rank the gradient's mesh
  HighestVertices highest;  ///< vertices of `mesh`; places are those among the critical simplices of all ranks
  PersistencePairs pairs;   ///< places likewise, in the order of CriticalSimplices by global ids
};

/// What `find_persistence_pairs` finds, of a gradient that may lie on several ranks. Each follows what is in its part:
/// paths to extrema, and the rims of its own 2-saddles until they meet one of its own 1-saddles. Gathered on the first
/// rank are critical simplices, with the extrema at which the paths of saddles end, and the critical edges of those
/// rims that leave a part: some 50 bytes a critical simplex. Where rising paths fork, `gather_gradient`'s gradient is.
///
/// Collective. Throws gale::Error on all ranks if that would be more than `most_bytes`; 0 stands for the first rank's
/// share of what its machine has left.
GALE_EXPORT GatheredPairs gather_persistence_pairs(const DiscreteGradient& gradient, const SweepOptions& options = {},
                                                   std::size_t most_bytes = 0);

}  // namespace gale
