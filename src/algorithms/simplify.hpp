#pragma once

#include <functional>

#include <gale/algorithms/morse_smale.hpp>
#include <gale/export.hpp>

namespace gale {

/// Simplifies a Morse-Smale complex by cancelling pairs of critical simplices (Gyulassy, Natarajan, Pascucci, Hamann,
/// "Efficient computation of Morse-Smale complexes for three-dimensional scalar functions", 2007). Two critical
/// simplices p below q may be cancelled if exactly one path leads from one to the other. Their persistence is the
/// difference of the values of their highest vertices. Again and again the pair of least persistence is cancelled, as
/// long as that is below `threshold`; of equal ones that of the lowest dimension, then of the lowest places. Cancelling
/// joins each other path to p with each other path from q: through the path between p and q, which is taken backwards,
/// and without loops.
///
/// - A minimum p: its descending manifold becomes part of that of the minimum at the other end of q.
/// - A maximum q: its ascending manifold becomes part of that of the maximum at the other end of p. If there is none,
///   because that path leaves through the mesh's surface, so does the manifold, and the paths to q are dropped.
/// - A 1-saddle p and a 2-saddle q: the descending wall of q becomes part of those that reach p, and the ascending wall
///   of p part of those that reach q. A pair whose cancelling would make more than 1024 paths when its turn comes is
///   left for good.
///
/// Paths are in the order of their saddles (connectors in that of 2-saddle, then 1-saddle); those of one saddle are in
/// the order in which cancelling made them. The Euler characteristic stays as it is. `complex` has all 1-separatrices
/// and connectors: throws gale::Error, naming the missing parts, if it was computed without (MorseSmaleParts).
/// `value(v)` is the field at an input vertex: throws gale::Error, naming the vertex, if that is NaN where it is asked
/// for. Sequential; time and memory grow with the number and the length of paths, none of which passes a cell twice.
GALE_EXPORT MorseSmaleComplex simplify(const MorseSmaleComplex& complex, const std::function<double(Id)>& value,
                                       double threshold);

}  // namespace gale
