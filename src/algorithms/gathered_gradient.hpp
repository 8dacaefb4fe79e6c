#pragma once

#include <cstddef>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/export.hpp>

namespace gale {

/// Gathers what of a gradient that lies on several ranks all its critical simplices reach, on the first of them: paths
/// down from 1-saddles and up from 2-saddles, and the triangles that fall from 2-saddles. Returns a gradient of a small
/// mesh of its own, which has these simplices alone, with their global ids (`vertex_id`, `cell_id`), and all critical
/// ones, in their order; on the other ranks an empty one. What `find_persistence_pairs`, `find_morse_smale_complex`
/// without manifolds and 2-separatrices, and `simplify` find in it is what they would find in the whole.
///
/// Collective, in as many rounds of messages as a path changes ranks. Some 30 bytes are gathered for each simplex on
/// these ways; SentMessages::gathered counts them. Throws gale::Error on all ranks, before anything is sent, if that is
/// more than `most_bytes`; 0 stands for the first rank's share of what its machine has left. On one rank it is the
/// gradient.
GALE_EXPORT DiscreteGradient gather_gradient(const DiscreteGradient& gradient, std::size_t most_bytes = 0);

}  // namespace gale
