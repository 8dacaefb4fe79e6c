#pragma once

#include <functional>
#include <memory>
#include <vector>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/export.hpp>

namespace gale {

/// How a track begins: at the first step; as part of what another extremum was; or out of nothing.
enum class TrackBegin { first_step, split, birth };

/// How a track ends: at the last step; as part of what another extremum is then; or as nothing.
enum class TrackEnd { last_step, merge, death };

/// A minimum or a maximum of one step.
struct TrackedExtremum {
  Id step;             ///< from 0
  Id track;            ///< its place in Tracks::tracks
  bool is_maximum;     ///< else it is a minimum
  Id vertex;           ///< input id; of a maximum the highest vertex of its cell
  double value;        ///< the field's there
  double persistence;  ///< above 0: how far it is from its saddle, or from the field's other end if it has none
};

/// An extremum through consecutive steps.
struct Track {
  std::vector<Id> extrema;                    ///< at least one: places in Tracks::extrema, a step after the other
  TrackBegin begin = TrackBegin::first_step;  ///< how it begins
  Id begin_at = no_id;                        ///< the extremum of the step before that a split was part of
  TrackEnd end = TrackEnd::last_step;         ///< how it ends
  Id end_at = no_id;                          ///< the extremum of the step after that a merge makes it part of
};

/// What ExtremumTracker has found.
struct Tracks {
  std::vector<double> times;             ///< the steps' times
  std::vector<TrackedExtremum> extrema;  ///< step after step; of each the minima, then the maxima, by input vertex
  std::vector<Id> step_begin{0};         ///< step s has the extrema step_begin[s] to step_begin[s + 1] - 1
  std::vector<Track> tracks;             ///< in the order of their first extrema
};

/// Tracks the minima and maxima of a field through its steps, which share a mesh.
///
/// An extremum goes on in the extremum of the next step whose manifold holds its vertex, if that one's vertex is in its
/// own manifold, too. All this is of each step's complex simplified below the step's threshold (`simplify`), where at
/// least the pairs of persistence 0 are cancelled; as there, the outside of the mesh is older than any maximum.
///
/// A track that doesn't go on merges with the extremum whose manifold holds its last vertex, if it was swallowed as it
/// was; else, or if no manifold holds that vertex, it dies. It was swallowed where some vertex of its manifold is
/// beyond its level in both steps, above it for a maximum, and the level is that of its saddle and the threshold: so
/// high it had to be to count. Splits and births are merges and deaths of the steps in reverse. What moves by more than
/// its width in a step is not recognised.
///
/// Beside what is found it keeps 8 bytes a vertex of the latest step, and that step's `value`.
class GALE_EXPORT ExtremumTracker {
 public:
  ExtremumTracker();
  ~ExtremumTracker();
  ExtremumTracker(ExtremumTracker&&) noexcept;             ///< moves; the other may be assigned to
  ExtremumTracker& operator=(ExtremumTracker&&) noexcept;  ///< moves

  /// Adds the next step. `value(v)` is the field at an input vertex, and is called until the step after has been added,
  /// by several threads.
  /// `threshold`, at least 0, is a difference of values; threads are 1 to most_threads. Throws gale::Error for others,
  /// if the step's mesh is another than the steps' before, or one rank's part of several, if its time or a value is
  /// NaN, and for no `value`; then nothing was added.
  void add(double time, const DiscreteGradient& gradient, std::function<double(Id)> value, double threshold = 0,
           int threads = host_threads());

  /// What was found up to the latest step, as if it were the last.
  const Tracks& tracks() const { return tracks_; }

 private:
  struct Step;
  void link(Id number, const Step& step);

  Tracks tracks_;
  std::unique_ptr<const Step> latest_;
};

}  // namespace gale
