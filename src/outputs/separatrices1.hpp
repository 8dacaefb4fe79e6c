#pragma once

#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/simplex_numbers.hpp>
#include <gale/outputs/critical_simplices.hpp>
#include <gale/outputs/heights.hpp>

namespace gale::outputs {

/// The edges and triangles that the files of a complex have to number: the critical ones, then those on the
/// 1-separatrices, as often as these pass.
NamedSimplices named_simplices(const MorseSmaleComplex& complex);

/// The 1-separatrices as lines of two points, each from a saddle through simplices of two dimensions in turn, in the
/// arrays that TTK has: descending ones from a critical edge over vertices and edges to a minimum, ascending ones from
/// a critical triangle over tetrahedra and triangles to a maximum, connectors from a critical edge over triangles and
/// edges to a critical triangle; in that order, each kind in the complex'. `numbers` are those of `named`. In parallel.
/// Throws gale::Error if there are more than 2^31 - 1 points.
io::Surface separatrices1(const io::Dataset& dataset, const MorseSmaleComplex& complex, const NamedSimplices& named,
                          const SimplexNumbers& numbers, const KnownSimplices& critical, const Heights& heights);

}  // namespace gale::outputs
