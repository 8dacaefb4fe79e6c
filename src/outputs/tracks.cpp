#include <algorithm>
#include <utility>

#include <gale/outputs/tracks.hpp>
#include <gale/outputs/values.hpp>

namespace gale::outputs {

void TrackLines::add(const io::Dataset& dataset, const io::PointArray& field, const Tracks& tracks) {
  std::visit(
      [&](const auto& points) {
        are_float_ = are_float_ && std::is_same_v<typename std::decay_t<decltype(points)>::non_const_value_type, float>;
        for (std::size_t i = points_.size() / 3; i < tracks.extrema.size(); ++i) {
          for (int axis = 0; axis < 3; ++axis) points_.push_back(points(tracks.extrema[i].vertex, axis));
        }
      },
      dataset.points);
  field_ = {field.name, 1, detail::values_as(field, {})};
}

namespace {

template <class Coordinate>
io::Dataset::Points<Coordinate> lifted(const std::vector<double>& points, const Tracks& tracks,
                                       const std::optional<Lift>& lift) {
  const io::Dataset::Points<Coordinate> all("GALE::track_points", points.size() / 3);
  for (std::size_t i = 0; i < all.extent(0); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const double by = lift && lift->axis == axis ? lift->scale * tracks.times[tracks.extrema[i].step] : 0;
      all(i, axis) = static_cast<Coordinate>(points[3 * i + axis] + by);
    }
  }
  return all;
}

std::int8_t type_of(const TrackedExtremum& one) { return one.is_maximum ? 3 : 0; }

}  // namespace

io::Surface TrackLines::lines(const Tracks& tracks, const std::optional<Lift>& lift) const {
  io::Surface surface;
  if (are_float_) {
    surface.points = lifted<float>(points_, tracks, lift);
  } else {
    surface.points = lifted<double>(points_, tracks, lift);
  }
  std::vector<Id> track, step, vertex, track_of_line;
  std::vector<std::int8_t> type, type_of_line, link;
  std::vector<double> time, value, persistence;
  for (const TrackedExtremum& one : tracks.extrema) {
    track.push_back(one.track);
    step.push_back(one.step);
    vertex.push_back(one.vertex);
    type.push_back(type_of(one));
    time.push_back(tracks.times[one.step]);
    value.push_back(one.value);
    persistence.push_back(one.persistence);
  }
  const auto add = [&](std::size_t of_track, std::int8_t kind, const std::vector<Id>& points) {
    surface.lines.points.insert(surface.lines.points.end(), points.begin(), points.end());
    surface.lines.begin.push_back(static_cast<std::int64_t>(surface.lines.points.size()));
    track_of_line.push_back(static_cast<Id>(of_track));
    type_of_line.push_back(type[points[0]]);
    link.push_back(kind);
  };
  const std::vector<Track>& all = tracks.tracks;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].extrema.size() > 1) add(i, 0, all[i].extrema);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].end == TrackEnd::merge) add(i, 1, {all[i].extrema.back(), all[i].end_at});
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].begin == TrackBegin::split) add(i, 2, {all[i].begin_at, all[i].extrema.front()});
  }
  surface.point_arrays = {{"TrackId", 1, std::move(track)},
                          {"Step", 1, std::move(step)},
                          {"Time", 1, std::move(time)},
                          {"CriticalType", 1, std::move(type)},
                          {"ttkVertexScalarField", 1, std::move(vertex)},
                          {field_.name, 1, detail::values_as(field_, std::move(value))},
                          {"Persistence", 1, detail::values_as(field_, std::move(persistence))}};
  surface.cell_arrays = {{"TrackId", 1, std::move(track_of_line)},
                         {"CriticalType", 1, std::move(type_of_line)},
                         {"LinkType", 1, std::move(link)}};
  return surface;
}

std::vector<io::PointArray> track_table(const Tracks& tracks) {
  std::vector<Id> id, first_step, last_step, begin_track, end_track, first_vertex, last_vertex;
  std::vector<std::int8_t> type, begin, end;
  std::vector<double> first_time, last_time, persistence;
  const auto track_at = [&](Id extremum) { return extremum == no_id ? no_id : tracks.extrema[extremum].track; };
  for (const Track& track : tracks.tracks) {
    const TrackedExtremum &first = tracks.extrema[track.extrema.front()], &last = tracks.extrema[track.extrema.back()];
    id.push_back(first.track);
    type.push_back(type_of(first));
    first_step.push_back(first.step);
    last_step.push_back(last.step);
    first_time.push_back(tracks.times[first.step]);
    last_time.push_back(tracks.times[last.step]);
    begin.push_back(static_cast<std::int8_t>(track.begin));
    begin_track.push_back(track_at(track.begin_at));
    end.push_back(static_cast<std::int8_t>(track.end));
    end_track.push_back(track_at(track.end_at));
    first_vertex.push_back(first.vertex);
    last_vertex.push_back(last.vertex);
    persistence.push_back(0);
    for (const Id one : track.extrema)
      persistence.back() = std::max(persistence.back(), tracks.extrema[one].persistence);
  }
  return {{"TrackId", 1, std::move(id)},
          {"CriticalType", 1, std::move(type)},
          {"FirstStep", 1, std::move(first_step)},
          {"LastStep", 1, std::move(last_step)},
          {"FirstTime", 1, std::move(first_time)},
          {"LastTime", 1, std::move(last_time)},
          {"Begin", 1, std::move(begin)},
          {"BeginTrack", 1, std::move(begin_track)},
          {"End", 1, std::move(end)},
          {"EndTrack", 1, std::move(end_track)},
          {"FirstVertex", 1, std::move(first_vertex)},
          {"LastVertex", 1, std::move(last_vertex)},
          {"Persistence", 1, std::move(persistence)}};
}

}  // namespace gale::outputs
