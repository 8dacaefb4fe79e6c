#include <gale/algorithms/critical_points.hpp>
#include <gale/app/commands/commands.hpp>
#include <gale/app/session.hpp>
#include <gale/io/arrays.hpp>
#include <gale/io/write.hpp>

namespace gale::app {

namespace {

/// Every k-th row of `points` that `ids` names.
template <class Coordinate>
io::Dataset::Points<Coordinate> positions_of(const io::Dataset::Points<Coordinate>& points,
                                             const std::vector<Id>& ids) {
  io::Dataset::Points<Coordinate> positions("positions", ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) positions(i, axis) = points(ids[i], axis);
  }
  return positions;
}

io::PointSet to_point_set(const io::Dataset& dataset, const CriticalPoints& points) {
  io::PointSet set;
  std::visit([&](const auto& all) { set.points = positions_of(all, points.vertices); }, dataset.points);
  for (const auto& array : dataset.arrays) set.arrays.push_back(io::gather(array, points.vertices));
  std::vector<std::int8_t> types, on_surface(points.on_surface.begin(), points.on_surface.end());
  for (const CriticalType type : points.types) types.push_back(static_cast<std::int8_t>(type));
  set.arrays.push_back({"CriticalType", 1, std::move(types)});
  set.arrays.push_back({"IsOnBoundary", 1, std::move(on_surface)});
  set.arrays.push_back({"ttkVertexScalarField", 1, points.vertices});
  return set;
}

void tell(const CriticalPoints& points, Session& session) {
  static const struct {
    CriticalType type;
    const char *name, *key;
  } kinds[] = {{CriticalType::minimum, "minima", "minima"},
               {CriticalType::saddle1, "1-saddles", "saddles1"},
               {CriticalType::saddle2, "2-saddles", "saddles2"},
               {CriticalType::maximum, "maxima", "maxima"},
               {CriticalType::degenerate, "degenerate", "degenerate"}};
  for (const auto& kind : kinds) {
    const Id count = points.counts[static_cast<int>(kind.type)];
    session.console().say(kind.name, grouped(count));
    session.report().result[kind.key] = count;
  }
}

}  // namespace

void critical_points(const Options& options) {
  require_extension(options, {".vtp"});
  Session session(options);
  const FieldOnMesh input = session.read_field();
  const auto structure = session.make_structure(input.mesh, critical_points_relations);
  CriticalPoints points;
  {
    const Stopwatch watch(session.report().seconds.run);
    points = find_critical_points(*structure, input.order, session.sweep("critical points"));
  }
  tell(points, session);
  session.write(options.output,
                [&](const std::string& path) { io::write_points(path, to_point_set(input.dataset, points)); });
  session.finish(structure.get());
}

}  // namespace gale::app
