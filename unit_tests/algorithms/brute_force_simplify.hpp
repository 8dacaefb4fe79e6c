#pragma once

#include <utility>
#include <vector>

#include "algorithms/named_complex.hpp"

namespace gale::test {

/// What `simplify` documents, by looking through all paths for the pair to cancel next, and writing out what each
/// cancellation makes of paths, walls and manifolds. Paths are sorted by their ends' places, then by their cells, walls
/// as in `as_defined`.
NamedComplex brute_force_simplified(const NamedComplex& complex, const std::vector<double>& field, double threshold);

/// The pairs that it cancels, in turn; the lower simplex of each first.
std::vector<std::pair<Simplex, Simplex>> brute_force_cancellations(const NamedComplex& complex,
                                                                   const std::vector<double>& field, double threshold);

/// With the paths in the order of that.
NamedComplex with_sorted_paths(NamedComplex complex);

}  // namespace gale::test
