#pragma once

#include <array>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include <gale/algorithms/persistence.hpp>

#include "algorithms/brute_force_gradient.hpp"

namespace gale::test {

/// Pairs of critical simplices, by the dimension of the lower one, and those in none, by dimension.
struct NamedPairs {
  std::array<std::set<std::pair<Simplex, Simplex>>, 3> pairs;
  std::array<std::set<Simplex>, 4> essential;
};

/// The pairs that GALE finds.
NamedPairs named_pairs(const DiscreteGradient& gradient, const PersistencePairs& pairs);

/// From a gradient, by its definition: boundaries in numbers of paths modulo 2, and the reduction of that matrix.
NamedPairs brute_force_pairs(const std::vector<double>& field, const BruteForceGradient& gradient);

/// The persistent homology of the mesh's simplices, without any gradient: for each pair that doesn't begin and end at
/// the same vertex its dimension and the two vertices at which it does; for what never ends -1 as the second.
using VertexPairs = std::multiset<std::tuple<int, Id, Id>>;
VertexPairs brute_force_vertex_pairs(const CellsOf& mesh, const std::vector<double>& field);

/// Names known pairs by their vertices.
VertexPairs vertex_pairs(const std::vector<double>& field, const NamedPairs& pairs);

}  // namespace gale::test
