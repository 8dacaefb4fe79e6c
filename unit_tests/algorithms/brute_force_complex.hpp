#pragma once

#include <string>
#include <vector>

#include "algorithms/brute_force_gradient.hpp"
#include "algorithms/named_complex.hpp"

namespace gale::test {

/// The Morse-Smale complex by its definition, from a gradient as pairs of simplices, with sets and maps. Walls and
/// polygons are sorted; pairs of manifolds have no numbers. Surfaces have neither walls nor connectors.
NamedComplex brute_force_complex(const CellsOf& mesh, const BruteForceGradient& gradient);

/// The complex of each of fields_on one of `mesh_names()`; found at the first call.
const std::vector<NamedComplex>& brute_force_complexes(const std::string& mesh_name);

}  // namespace gale::test
