#include <gale/io/dataset.hpp>
#include <gale/outputs/critical_points.hpp>
#include <gale/outputs/values.hpp>

namespace gale::outputs {

io::PointSet to_point_set(const io::Dataset& dataset, const CriticalPoints& points, const Exchange& exchange) {
  io::PointSet set;
  std::visit([&](const auto& all) { set.points = detail::points_at(all, points.vertices); }, dataset.points);
  for (const auto& array : dataset.arrays) set.arrays.push_back(io::gather(array, points.vertices));
  std::vector<std::int8_t> types, on_surface(points.on_surface.begin(), points.on_surface.end());
  for (const CriticalType type : points.types) types.push_back(static_cast<std::int8_t>(type));
  set.arrays.push_back({"CriticalType", 1, std::move(types)});
  set.arrays.push_back({"IsOnBoundary", 1, std::move(on_surface)});
  std::vector<GlobalId> ids;
  for (const Id vertex : points.vertices) ids.push_back(exchange.vertex_id(vertex));
  set.arrays.push_back({"ttkVertexScalarField", 1, detail::ids_as(exchange, std::move(ids))});
  return set;
}

}  // namespace gale::outputs
