#pragma once

#include <cstdint>
#include <vector>

#include "support/brute_force.hpp"

namespace gale::test {

/// The type of each vertex (0 to 5, see CriticalType) by the definition, from sets of input ids: components of the
/// lower and of the upper neighbours, joined where two are on one side in one tetrahedron of the star.
std::vector<int> brute_force_types(const InputMesh& mesh, const BruteForce& brute_force,
                                   const std::vector<double>& field);

}  // namespace gale::test
