#pragma once

#include <optional>
#include <string>
#include <vector>

#include <gale/algorithms/tracking.hpp>
#include <gale/export.hpp>
#include <gale/io/write.hpp>

namespace gale::outputs {

/// Moves points along an axis by their times, so that lines of a plane rise through time.
struct Lift {
  int axis = 2;      ///< the coordinate, 0 to 2
  double scale = 1;  ///< what a unit of time adds to it
};

/// Tracks as lines: where the extrema of all steps are, and what the field is called there.
class GALE_EXPORT TrackLines {
 public:
  /// Takes the points of the latest step's extrema from its dataset, and the field's name and type. To be called once a
  /// step.
  void add(const io::Dataset& dataset, const io::PointArray& field, const Tracks& tracks);

  /// A line for each track of several steps, from its first extremum to its last; then one for each merge, from the
  /// last extremum of the track to the one that it is part of in the next step, and one for each split likewise,
  /// forward in time. Points are all extrema, step after step, in float if those of all steps are, else in double;
  /// lifted if that is wanted.
  ///
  /// Point arrays: TrackId, Step, ttkVertexScalarField (int32), Time (double), CriticalType (int8: 0 minima, 3 maxima),
  /// the field and Persistence (float if the field is, else double). Cell arrays: TrackId (int32; of merges and splits
  /// that of the track which ends or begins), CriticalType, LinkType (int8: 0 tracks, 1 merges, 2 splits).
  io::Surface lines(const Tracks& tracks, const std::optional<Lift>& lift = std::nullopt) const;

 private:
  std::vector<double> points_;
  bool are_float_ = true;
  io::PointArray field_;  ///< without values
};

/// The tracks in columns, a row each. TrackId, CriticalType (int8: 0 minima, 3 maxima), FirstStep, LastStep (int32),
/// FirstTime, LastTime (double), Begin (int8: 0 at the first step, 1 as a split, 2 as a birth), BeginTrack (int32: what
/// it splits from, -1 for none), End (int8: 0 at the last step, 1 by a merge, 2 by death), EndTrack (int32: what it
/// merges with, -1 for none), FirstVertex, LastVertex (int32), Persistence (double: the greatest of its steps).
GALE_EXPORT std::vector<io::PointArray> track_table(const Tracks& tracks);

}  // namespace gale::outputs
