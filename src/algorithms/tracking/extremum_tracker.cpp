#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <gale/algorithms/morse_smale/parts.hpp>
#include <gale/algorithms/order/require.hpp>
#include <gale/algorithms/persistence/cancellations.hpp>
#include <gale/algorithms/tracking.hpp>
#include <gale/base/atomic.hpp>
#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/threads.hpp>

namespace gale {

/// What the steps before and after are to know of one.
struct ExtremumTracker::Step {
  Mesh mesh;
  std::function<double(Id)> value;
  double threshold;
  std::array<Mirrored<Id>, 2> manifolds;     ///< descending and ascending ones, not simplified
  std::array<std::vector<Id>, 2> tracked{};  ///< for each of these its heir's place among `extrema`; no_id: outside
  std::vector<TrackedExtremum> extrema{};    ///< without tracks
  std::array<const Id*, 2> of_vertex{nullptr, nullptr};  ///< `manifolds` on the host

  /// The extremum whose manifold holds a vertex; no_id if none does.
  Id holder(bool is_maximum, Id vertex) const {
    const Id manifold = of_vertex[is_maximum ? 1 : 0][vertex];
    return manifold == no_id ? no_id : tracked[is_maximum ? 1 : 0][manifold];
  }

  /// For which of the extrema, of those that are `asked` for, a vertex that they held beyond their level is beyond it
  /// in another step, too.
  std::vector<char> stand_in(const Step& other, const std::vector<char>& asked) const {
    std::vector<char> stand(extrema.size(), 0);
    if (std::find(asked.begin(), asked.end(), 1) == asked.end()) return stand;
    parallel_for("GALE::extrema_stand", HostExecutionSpace(), mesh.vertices(), [&](Offset v) {
      const auto vertex = static_cast<Id>(v);
      for (const bool is_maximum : {false, true}) {
        const Id place = holder(is_maximum, vertex);
        if (place == no_id || asked[place] == 0) continue;
        const double side = is_maximum ? 1 : -1;
        const double level = side * extrema[place].value - extrema[place].persistence + threshold;
        if (side * value(vertex) > level && side * other.value(vertex) > level) atomic_write(&stand[place], 1);
      }
    });
    return stand;
  }
};

namespace {

/// The persistence of each extremum of a kind: by place, of those in no pair the difference to `other_end`.
std::vector<double> persistences(bool is_maximum, const std::vector<PersistencePair>& pairs,
                                 const std::vector<double>& extrema, const std::vector<double>& saddles,
                                 double other_end) {
  std::vector<double> ends(extrema.size(), other_end);
  for (const PersistencePair& pair : pairs) {
    if (is_maximum) {
      ends[pair.upper] = saddles[pair.lower];
    } else {
      ends[pair.lower] = saddles[pair.upper];
    }
  }
  for (std::size_t i = 0; i < ends.size(); ++i)
    ends[i] = ends[i] == extrema[i] ? 0 : is_maximum ? extrema[i] - ends[i] : ends[i] - extrema[i];
  return ends;
}

/// The field's greatest value.
double greatest(const VertexOrder& order, const std::function<double(Id)>& value) {
  return value(order.mesh().vertices_in_input()[order.highest({0, order.mesh().vertices()})]);
}

/// Puts the extrema of a kind that are left behind `all`, by vertex. Returns for each place that of its heir there.
std::vector<Id> add_left(std::vector<TrackedExtremum> extrema, const std::vector<char>& is_left,
                         const std::vector<Id>& heirs, std::vector<TrackedExtremum>& all) {
  std::vector<Id> left, place(extrema.size(), no_id), heir_place(extrema.size(), no_id);
  for (std::size_t i = 0; i < extrema.size(); ++i) {
    if (is_left[i]) left.push_back(static_cast<Id>(i));
  }
  std::sort(left.begin(), left.end(),
            [&](Id a, Id b) { return std::pair(extrema[a].vertex, a) < std::pair(extrema[b].vertex, b); });
  for (const Id i : left) {
    place[i] = static_cast<Id>(all.size());
    all.push_back(extrema[i]);
  }
  for (std::size_t i = 0; i < extrema.size(); ++i) heir_place[i] = heirs[i] == no_id ? no_id : place[heirs[i]];
  return heir_place;
}

/// Finds the extrema of a step that are left below its threshold, and which manifold is whose.
void find_extrema(const DiscreteGradient& gradient, int threads, const std::function<double(Id)>& value,
                  double threshold, std::array<std::vector<Id>, 2>& tracked, std::vector<TrackedExtremum>& left) {
  const CriticalSimplices& critical = gradient.critical();
  const detail::CriticalValues values = detail::critical_values(gradient, value);
  const double least = std::max(threshold, std::numeric_limits<double>::denorm_min());
  const detail::Cancellations found = detail::cancel_below(least, MorseSmaleComplex{gradient, {}, critical}, values,
                                                           /*extrema_only=*/true, /*want_joined=*/false, threads);
  const OtherIds input = gradient.mesh().vertices_in_input();
  const int top = critical.dimension;
  const auto& minima = values[0];
  const auto of_minima =
      persistences(false, found.pairs.pairs[0], minima, values[1], greatest(gradient.order(), value));
  const auto of_maxima = persistences(true, found.pairs.pairs[top - 1], values[top], values[top - 1],
                                      *std::min_element(minima.begin(), minima.end()));
  std::vector<TrackedExtremum> lower, upper;
  for (std::size_t i = 0; i < minima.size(); ++i)
    lower.push_back({0, no_id, false, input[critical.vertices[i]], minima[i], of_minima[i]});
  for (std::size_t i = 0; i < critical.cells.size(); ++i) {
    const Id vertex = input[detail::highest_corner(gradient, critical.cells[i])];
    upper.push_back({0, no_id, true, vertex, values[top][i], of_maxima[i]});
  }
  tracked[0] = add_left(std::move(lower), found.is_left[0], found.heir_of_minimum, left);
  tracked[1] = add_left(std::move(upper), found.is_left[top], found.heir_of_maximum, left);
}

}  // namespace

ExtremumTracker::ExtremumTracker() = default;
ExtremumTracker::~ExtremumTracker() = default;
ExtremumTracker::ExtremumTracker(ExtremumTracker&&) noexcept = default;
ExtremumTracker& ExtremumTracker::operator=(ExtremumTracker&&) noexcept = default;

void ExtremumTracker::add(double time, const DiscreteGradient& gradient, std::function<double(Id)> value,
                          double threshold, int threads) {
  detail::require_whole_mesh("tracks", gradient.mesh());
  const auto number = static_cast<Id>(tracks_.times.size());
  if (latest_ && !(latest_->mesh == gradient.mesh()))
    throw Error("step " + std::to_string(number) +
                " has another mesh than the steps before it: tracks are of one mesh");
  if (std::isnan(time)) throw Error("the time of step " + std::to_string(number) + " is NaN");
  detail::require_threshold(threshold);
  detail::require_thread_count(threads);
  if (!value) throw Error("tracks need the field's values");
  const ThreadLimit limit(threads);
  auto step =
      std::make_unique<Step>(Step{gradient.mesh(),
                                  std::move(value),
                                  threshold,
                                  {detail::descending_manifolds(gradient), detail::ascending_manifolds(gradient)}});
  for (int kind = 0; kind < 2; ++kind) step->of_vertex[kind] = step->manifolds[kind].in<HostMemory>().data();
  find_extrema(gradient, threads, step->value, threshold, step->tracked, step->extrema);
  link(number, *step);
  tracks_.times.push_back(time);
  tracks_.step_begin.push_back(static_cast<Id>(tracks_.extrema.size()));
  latest_ = std::move(step);
}

void ExtremumTracker::link(Id number, const Step& step) {
  std::vector<Id> after, before(step.extrema.size(), no_id);
  if (latest_) {
    for (const TrackedExtremum& one : latest_->extrema) after.push_back(step.holder(one.is_maximum, one.vertex));
    for (std::size_t i = 0; i < before.size(); ++i)
      before[i] = latest_->holder(step.extrema[i].is_maximum, step.extrema[i].vertex);
  }
  const auto alone = [](const std::vector<Id>& ahead, const std::vector<Id>& back) {
    std::vector<char> is_alone;
    for (std::size_t i = 0; i < ahead.size(); ++i)
      is_alone.push_back(ahead[i] != no_id && back[ahead[i]] != static_cast<Id>(i) ? 1 : 0);
    return is_alone;
  };
  const std::vector<char> merges = latest_ ? latest_->stand_in(step, alone(after, before)) : std::vector<char>(),
                          splits = latest_ ? step.stand_in(*latest_, alone(before, after)) : std::vector<char>();
  const Id first = tracks_.step_begin.back(), first_before = latest_ ? tracks_.step_begin[number - 1] : no_id;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Id place = first + static_cast<Id>(i), other = before[i];
    TrackedExtremum one = step.extrema[i];
    one.step = number;
    if (other != no_id && after[other] == static_cast<Id>(i)) {
      one.track = tracks_.extrema[first_before + other].track;
      tracks_.tracks[one.track].extrema.push_back(place);
    } else {
      one.track = static_cast<Id>(tracks_.tracks.size());
      Track track{{place}};
      if (latest_) track.begin = splits[i] != 0 ? TrackBegin::split : TrackBegin::birth;
      if (track.begin == TrackBegin::split) track.begin_at = first_before + other;
      tracks_.tracks.push_back(track);
    }
    tracks_.extrema.push_back(one);
  }
  for (std::size_t i = 0; i < after.size(); ++i) {
    const Id other = after[i];
    if (other != no_id && before[other] == static_cast<Id>(i)) continue;
    Track& track = tracks_.tracks[tracks_.extrema[first_before + static_cast<Id>(i)].track];
    track.end = merges[i] != 0 ? TrackEnd::merge : TrackEnd::death;
    if (track.end == TrackEnd::merge) track.end_at = first + other;
  }
}

}  // namespace gale
