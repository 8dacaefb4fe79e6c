#include <gale/app/critical_counts.hpp>
#include <gale/app/ranks/rank_session.hpp>
#include <gale/app/ranks/ranks.hpp>
#include <gale/distributed/distributed_critical_points.hpp>
#include <gale/io/dataset.hpp>

namespace gale::app {

namespace {

/// This rank's, with the arrays that outputs::to_point_set gives them; ids have 64 bits.
io::PointSet to_point_set(const FieldOnRanks& on, const DistributedCriticalPoints& found) {
  std::vector<Id> at;
  for (const GlobalId id : found.vertices) at.push_back(on.mesh.vertex_of(id));
  io::PointSet set;
  std::visit(
      [&](const auto& all) {
        const std::decay_t<decltype(all)> points("GALE::critical_points", at.size());
        for (std::size_t i = 0; i < at.size(); ++i) {
          for (int axis = 0; axis < 3; ++axis) points(i, axis) = all(at[i], axis);
        }
        set.points = points;
      },
      on.local.points);
  for (const io::PointArray& array : on.local.arrays) set.arrays.push_back(io::gather(array, at));
  std::vector<std::int8_t> types, on_surface(found.on_surface.begin(), found.on_surface.end());
  for (const CriticalType type : found.types) types.push_back(static_cast<std::int8_t>(type));
  set.arrays.push_back({"CriticalType", 1, std::move(types)});
  set.arrays.push_back({"IsOnBoundary", 1, std::move(on_surface)});
  set.arrays.push_back(
      {"ttkVertexScalarField", 1, std::vector<std::int64_t>(found.vertices.begin(), found.vertices.end())});
  return set;
}

}  // namespace

void critical_points_on_ranks(const InputOptions& input, const CommonOptions& common,
                              const SegmentationOptions& segmentation, const StructureOption& structure,
                              const std::string& output) {
  RankSession session(input, common, {output});
  const FieldOnRanks on = session.read_field(segmentation);
  const DistributedCriticalPoints found = session.find(
      structure, on.mesh.local(), critical_points_relations,
      [&](Structure& local) { return find_critical_points(local, on.order, session.sweep()); },
      [&] { return find_critical_points(WorkerSpace(), on.order, structure.device_sweep()); });
  tell_points({found.counts.begin(), found.counts.end()}, session.console(), session.report());
  if (!output.empty()) session.write_pieces(output, to_point_set(on, found));
  session.finish(on.mesh);
}

}  // namespace gale::app
