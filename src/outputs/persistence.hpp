#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <gale/algorithms/persistence.hpp>
#include <gale/export.hpp>
#include <gale/io/dataset.hpp>
#include <gale/io/write.hpp>

namespace gale::outputs {

/// A threshold of persistence: a difference of the field's values, or a part of the field's range.
struct Persistence {
  double value = 0;         ///< at least 0
  bool is_percent = false;  ///< whether `value` is in percent of the range
};

/// The threshold as a difference of values: what `simplify` takes. NaN is no part of the range, which is that of the
/// values on all `ranks`: collective where there are several. Throws gale::Error for one that isn't 0 or more, and,
/// with the field's name, for percents of a range that isn't finite.
GALE_EXPORT double threshold_of(const Persistence& persistence, const io::PointArray& field,
                                const Ranks& ranks = Ranks::alone());

/// A class of homology: where it begins and where it ends.
struct DiagramPoint {
  std::int8_t type;            ///< the dimension of the class
  bool is_finite;              ///< whether it ends; if not, its end is the field's highest vertex
  Id begin;                    ///< input id of the highest vertex of the simplex that begins it
  Id end;                      ///< input id of the highest vertex of the simplex that ends it
  double birth;                ///< the field's value at `begin`
  double death;                ///< the field's value at `end`
  std::int8_t end_type;        ///< the CriticalType of the simplex that ends it, 3 if none does
  std::int8_t begin_type = 0;  ///< the CriticalType of the simplex that begins it

  /// The difference of the two values; 0 where they are equal, infinities included.
  double persistence() const { return birth == death ? 0 : death - birth; }
};

/// All pairs and essential classes, by type; of one type the pairs in their order, then the essential classes. Without
/// the pairs whose persistence is below `least`; what never ends is always there. `field` is that of the gradient.
/// Throws gale::Error for a `least` that isn't 0 or more.
GALE_EXPORT std::vector<DiagramPoint> persistence_diagram(const DiscreteGradient& gradient,
                                                          const PersistencePairs& pairs, const io::PointArray& field,
                                                          double least = 0);

/// All pairs and essential classes that were gathered, with the values of the mesh that has these vertices.
GALE_EXPORT std::vector<DiagramPoint> persistence_diagram(const HighestVertices& highest, const PersistencePairs& pairs,
                                                          const io::PointArray& field, double least = 0);

/// How many pairs and essential classes a diagram has.
struct DiagramCounts {
  Id pairs[3] = {};      ///< by the dimension of the class, 0 to 2
  Id essential[4] = {};  ///< by dimension, 0 to 3
};

/// Counts what a diagram has.
GALE_EXPORT DiagramCounts counts_of(const std::vector<DiagramPoint>& diagram);

/// The diagram as lines, one for each of its points, from (birth, birth, 0) to (birth, death, 0), then the diagonal,
/// from the first birth to the last. In float if the field is, else in double.
///
/// Point arrays: ttkVertexScalarField (int32, the input vertex), CriticalType (int8: the dimension of the
/// simplex; of a triangle mesh what TTK has: 1 saddles that end classes, 2 those that begin them, 3 maxima),
/// Coordinates (of that vertex). Cell arrays: PairIdentifier (int32, from 0; the diagonal -1), PairType (int8; the
/// diagonal -1), Persistence and Birth (float if the field is, else double; of the diagonal twice the greatest finite
/// persistence, and the first birth), IsFinite (uint8; the diagonal 0).
///
/// Vertices have their global ids, in int64, where the gradient was gathered, whose mesh's `exchange` it is.
GALE_EXPORT io::Surface to_lines(const io::Dataset& dataset, const io::PointArray& field,
                                 const std::vector<DiagramPoint>& diagram,
                                 const Exchange& exchange = Exchange::of_whole_mesh());

/// How many pairs persist: for each persistence that a pair has, ascending, the number of pairs of each type of that
/// persistence or more. What never ends doesn't count.
struct PersistenceCurve {
  std::vector<double> persistence;  ///< each that occurs once, ascending
  std::vector<Id> pairs[3];         ///< by type; as many entries as `persistence`
};

/// Makes the curve of a diagram.
GALE_EXPORT PersistenceCurve persistence_curve(const std::vector<DiagramPoint>& diagram);

/// The curve's columns: Persistence, MinimumSaddle, SaddleSaddle, SaddleMaximum, All.
GALE_EXPORT std::vector<io::PointArray> curve_table(const PersistenceCurve& curve);

/// Writes a curve as comma-separated values, with a line of titles. Numbers are written such that they are read back as
/// they are.
GALE_EXPORT std::string to_csv(const PersistenceCurve& curve);

}  // namespace gale::outputs
