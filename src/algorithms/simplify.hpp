#pragma once

#include <functional>

#include <gale/algorithms/morse_smale.hpp>
#include <gale/export.hpp>

namespace gale {

/// How to simplify a Morse-Smale complex.
struct SimplifyOptions {
  bool extrema_only = false;     ///< cancel no 1-saddle with a 2-saddle: a small part of the time
  Paths paths = Paths::whole;    ///< `joined`: memory in proportion to what is left, however often paths meet
  int threads = host_threads();  ///< 1 to most_threads
};

/// Simplifies a Morse-Smale complex: cancels the pairs of critical simplices whose persistence, the difference of the
/// values of their highest vertices, is below `threshold` (`find_persistence_pairs`), as far as paths allow. What is
/// left is the complex of another gradient, in which the paths between cancelled simplices are turned around (Forman
/// 1998; Gyulassy, Natarajan, Pascucci, Hamann 2007).
///
/// - Minima and maxima with their saddles: always possible. The manifold of the extremum becomes part of that of the
///   one at the saddle's other end. If that is the outside of the mesh, the vertices have no maximum then. A triangle
///   mesh has no other pairs.
/// - A 1-saddle and a 2-saddle: possible if one path leads from one to the other. Where several do, two others that are
///   to go and differ by less than `threshold` are cancelled instead, the least different first; and a 1-saddle may
///   change places with one that was cancelled with a minimum. So nearly all are cancelled. `kept_below` of the result
///   says how many weren't.
///
/// Paths (whole, or joined), walls and their order are those that `find_morse_smale_complex` gives for that gradient,
/// with three exceptions. A connector whose 1-saddle is higher than its 2-saddle is left out. An ascending wall
/// consists of those of the 1-saddles that it leads past, each cell once. Where a triangle has three tetrahedra or
/// more, rising paths take one way.
///
/// On one rank's part of several it is collective: all that critical simplices reach is gathered on the first rank
/// (`gather_gradient`; with ascending walls where 2-separatrices are among its parts), whose result has what is left of
/// all ranks' critical simplices and their separatrices, the others' none; manifolds are on all. So nothing of
/// `complex` but its gradient, manifolds and parts is read there.
///
/// The Euler characteristic stays as it is. `complex` isn't simplified, and has saddle connectors, unless
/// `extrema_only` or on a triangle mesh: throws gale::Error otherwise, and for a threshold that isn't 0 or more. Parts
/// that it was computed without aren't in the result. `value(v)` is the field at an input vertex: throws gale::Error,
/// naming the vertex, if that is NaN where it is asked for. On options.threads threads, but for the cancelling itself.
/// Memory grows with what is left, and with the gradient (4 bytes a vertex and a tetrahedron).
GALE_EXPORT MorseSmaleComplex simplify(const MorseSmaleComplex& complex, const std::function<double(Id)>& value,
                                       double threshold, const SimplifyOptions& options = {});

}  // namespace gale
