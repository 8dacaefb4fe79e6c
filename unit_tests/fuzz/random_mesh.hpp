#pragma once

#include <vector>

#include "fuzz/random.hpp"
#include "support/input_mesh.hpp"

namespace gale::fuzz {

/// Tetrahedra that are glued in one of many ways: any four of a few vertices, so that nothing is a manifold; all around
/// one vertex, one edge or one triangle, for huge degrees; a chain; or parts of a grid. Some vertices may have none.
/// Ids and corners are shuffled.
test::InputMesh random_mesh(Random& random);

/// Few values, so that many are equal, or many.
std::vector<double> random_field(std::size_t vertices, Random& random);

}  // namespace gale::fuzz
