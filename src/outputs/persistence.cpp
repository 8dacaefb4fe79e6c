#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include <gale/algorithms/order/require.hpp>
#include <gale/base/error.hpp>
#include <gale/outputs/field.hpp>
#include <gale/outputs/persistence.hpp>
#include <gale/outputs/values.hpp>

namespace gale::outputs {

namespace {

/// Largest less smallest value of all ranks.
double range_of(const io::PointArray& field, const Ranks& ranks) {
  double least = HUGE_VAL, most = -HUGE_VAL;
  std::visit(
      [&](const auto& values) {
        for (const auto value : values) {
          least = std::min(least, static_cast<double>(value));  // skips NaN: no comparison with it holds
          most = std::max(most, static_cast<double>(value));
        }
      },
      field.values);
  if (ranks.size() == 1) return most - least;
  least = ranks.least(least);
  return -ranks.least(-most) - least;
}

}  // namespace

double threshold_of(const Persistence& persistence, const io::PointArray& field, const Ranks& ranks) {
  gale::detail::together(ranks, [&] { gale::detail::require_threshold(persistence.value); });
  if (!persistence.is_percent) return persistence.value;
  const double range = range_of(field, ranks);
  if (!std::isfinite(range))
    throw Error("there are no percents of the range of '" + field.name + "', which isn't finite");
  return persistence.value / 100 * range;
}

namespace {

io::PointArray::Values positions_of(const io::Dataset& dataset, const std::vector<Id>& vertices) {
  return std::visit(
      [&](const auto& points) -> io::PointArray::Values {
        std::vector<typename std::decay_t<decltype(points)>::non_const_value_type> positions;
        positions.reserve(3 * vertices.size());
        for (const Id v : vertices) positions.insert(positions.end(), {points(v, 0), points(v, 1), points(v, 2)});
        return positions;
      },
      dataset.points);
}

/// Two points for each of the diagram's: where the class begins, and where it ends.
template <class Coordinate>
io::Dataset::Points<Coordinate> points_of(const std::vector<DiagramPoint>& diagram) {
  const io::Dataset::Points<Coordinate> points("GALE::persistence_diagram", 2 * diagram.size());
  for (std::size_t i = 0; i < diagram.size(); ++i) {
    points(2 * i, 0) = points(2 * i, 1) = points(2 * i + 1, 0) = static_cast<Coordinate>(diagram[i].birth);
    points(2 * i + 1, 1) = static_cast<Coordinate>(diagram[i].death);
  }
  return points;
}

void add_diagonal(const std::vector<DiagramPoint>& diagram, io::Surface& lines, std::vector<double>& persistence,
                  std::vector<double>& births) {
  if (diagram.empty()) return;
  const auto [first, last] = std::minmax_element(diagram.begin(), diagram.end(),
                                                 [](const auto& a, const auto& b) { return a.birth < b.birth; });
  lines.lines.points.push_back(static_cast<std::int32_t>(2 * (first - diagram.begin())));
  lines.lines.points.push_back(static_cast<std::int32_t>(2 * (last - diagram.begin())));
  lines.lines.begin.push_back(static_cast<std::int64_t>(lines.lines.points.size()));
  double most = 0;
  for (const DiagramPoint& point : diagram) most = std::max(most, point.is_finite ? point.persistence() : 0);
  persistence.push_back(2 * most);
  births.push_back(first->birth);
}

}  // namespace

std::vector<DiagramPoint> persistence_diagram(const DiscreteGradient& gradient, const PersistencePairs& pairs,
                                              const io::PointArray& field, double least) {
  return persistence_diagram(highest_vertices(gradient), pairs, field, least);
}

std::vector<DiagramPoint> persistence_diagram(const HighestVertices& vertices, const PersistencePairs& pairs,
                                              const io::PointArray& field, double least) {
  gale::detail::require_threshold(least);
  const auto highest = [&](int dimension, Id place) { return vertices.of_critical[dimension][place]; };
  const auto value = [&](Id vertex) { return value_at(field, vertex); };
  std::vector<DiagramPoint> diagram;
  const Id last = vertices.of_all;
  const bool is_surface = vertices.dimension == 2;
  const std::array<std::int8_t, 4> begin_types = {0, std::int8_t(is_surface ? 2 : 1), std::int8_t(is_surface ? 3 : 2),
                                                  3};
  const std::array<std::int8_t, 3> end_types = {1, std::int8_t(is_surface ? 3 : 2), 3};
  for (int type = 0; type < 4; ++type) {
    const auto type8 = static_cast<std::int8_t>(type);
    for (std::size_t i = 0; type < 3 && i < pairs.pairs[type].size(); ++i) {
      const Id begin = highest(type, pairs.pairs[type][i].lower);
      const Id end = highest(type + 1, pairs.pairs[type][i].upper);
      const DiagramPoint point{type8, true, begin, end, value(begin), value(end), end_types[type], begin_types[type]};
      if (point.persistence() >= least) diagram.push_back(point);
    }
    for (const Id place : pairs.essential[type]) {
      const Id begin = highest(type, place);
      diagram.push_back({type8, false, begin, last, value(begin), value(last), 3, begin_types[type]});
    }
  }
  return diagram;
}

DiagramCounts counts_of(const std::vector<DiagramPoint>& diagram) {
  DiagramCounts counts;
  for (const DiagramPoint& point : diagram) ++(point.is_finite ? counts.pairs : counts.essential)[point.type];
  return counts;
}

io::Surface to_lines(const io::Dataset& dataset, const io::PointArray& field, const std::vector<DiagramPoint>& diagram,
                     const Exchange& exchange) {
  std::vector<Id> vertices, identifiers;
  std::vector<std::int8_t> critical_types, types;
  std::vector<double> persistence, births;
  std::vector<std::uint8_t> finite;
  io::Surface lines;
  for (std::size_t i = 0; i < diagram.size(); ++i) {
    const DiagramPoint& point = diagram[i];
    for (const Id vertex : {point.begin, point.end}) {
      lines.lines.points.push_back(static_cast<std::int32_t>(vertices.size()));
      vertices.push_back(vertex);
    }
    lines.lines.begin.push_back(static_cast<std::int64_t>(lines.lines.points.size()));
    critical_types.insert(critical_types.end(), {point.begin_type, point.end_type});
    identifiers.push_back(static_cast<Id>(i));
    types.push_back(point.type);
    persistence.push_back(point.persistence());
    births.push_back(point.birth);
    finite.push_back(point.is_finite);
  }
  add_diagonal(diagram, lines, persistence, births);
  identifiers.resize(persistence.size(), -1);
  types.resize(persistence.size(), -1);
  finite.resize(persistence.size(), 0);
  if (std::holds_alternative<std::vector<float>>(field.values)) {
    lines.points = points_of<float>(diagram);
  } else {
    lines.points = points_of<double>(diagram);
  }
  lines.point_arrays.push_back({"Coordinates", 3, positions_of(dataset, vertices)});
  std::vector<GlobalId> ids;
  for (const Id vertex : vertices) ids.push_back(exchange.vertex_id(vertex));
  lines.point_arrays.push_back({"ttkVertexScalarField", 1, detail::ids_as(exchange, std::move(ids))});
  lines.point_arrays.push_back({"CriticalType", 1, std::move(critical_types)});
  lines.cell_arrays.push_back({"PairIdentifier", 1, std::move(identifiers)});
  lines.cell_arrays.push_back({"PairType", 1, std::move(types)});
  lines.cell_arrays.push_back({"Persistence", 1, detail::values_as(field, std::move(persistence))});
  lines.cell_arrays.push_back({"Birth", 1, detail::values_as(field, std::move(births))});
  lines.cell_arrays.push_back({"IsFinite", 1, std::move(finite)});
  return lines;
}

PersistenceCurve persistence_curve(const std::vector<DiagramPoint>& diagram) {
  std::array<std::vector<double>, 3> by_type;
  PersistenceCurve curve;
  for (const DiagramPoint& point : diagram) {
    if (!point.is_finite) continue;
    by_type[point.type].push_back(point.persistence());
    curve.persistence.push_back(point.persistence());
  }
  const auto sort = [](std::vector<double>& values) { std::sort(values.begin(), values.end()); };
  sort(curve.persistence);
  curve.persistence.erase(std::unique(curve.persistence.begin(), curve.persistence.end()), curve.persistence.end());
  for (int type = 0; type < 3; ++type) {
    auto& values = by_type[type];
    sort(values);
    auto first = values.begin();
    for (const double least : curve.persistence) {
      while (first != values.end() && *first < least) ++first;
      curve.pairs[type].push_back(static_cast<Id>(values.end() - first));
    }
  }
  return curve;
}

std::vector<io::PointArray> curve_table(const PersistenceCurve& curve) {
  std::vector<Id> all(curve.persistence.size(), 0);
  for (const auto& pairs : curve.pairs) {
    for (std::size_t i = 0; i < all.size(); ++i) all[i] += pairs[i];
  }
  return {{"Persistence", 1, curve.persistence},
          {"MinimumSaddle", 1, curve.pairs[0]},
          {"SaddleSaddle", 1, curve.pairs[1]},
          {"SaddleMaximum", 1, curve.pairs[2]},
          {"All", 1, all}};
}

std::string to_csv(const PersistenceCurve& curve) { return io::to_csv(curve_table(curve)); }

}  // namespace gale::outputs
