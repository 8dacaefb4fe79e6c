#pragma once

#include <vector>

#include <gale/algorithms/morse_smale.hpp>
#include <gale/export.hpp>
#include <gale/io/write.hpp>

namespace gale::outputs {

/// The manifolds of a complex as point arrays of its mesh (int32, in input order): AscendingManifold,
/// DescendingManifold and MorseSmaleManifold, in that order, with the numbers that `MorseSmaleComplex` has. Those that
/// the complex was found without are left out. On one rank's part of a mesh they are int64.
GALE_EXPORT std::vector<io::PointArray> manifold_arrays(const MorseSmaleComplex& complex);

/// How many vertices are in the manifold of each critical simplex, as the array ManifoldSize (int32): in the order of
/// `to_point_set`, dimension by dimension. Minima have descending manifolds, maxima ascending ones, saddles none (0).
/// -1 for minima or maxima whose manifolds the complex was found without. On one rank's part of a mesh it has the
/// vertices of all ranks, and is int64 and collective.
GALE_EXPORT io::PointArray manifold_sizes(const MorseSmaleComplex& complex);

}  // namespace gale::outputs
