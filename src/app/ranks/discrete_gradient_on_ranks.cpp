#include <gale/app/critical_counts.hpp>
#include <gale/app/ranks/rank_session.hpp>
#include <gale/app/ranks/ranks.hpp>
#include <gale/distributed/distributed_gradient.hpp>

namespace gale::app {

void discrete_gradient_on_ranks(const InputOptions& input, const CommonOptions& common,
                                const SegmentationOptions& segmentation, const StructureOption& structure) {
  RankSession session(input, common, "");
  const FieldOnRanks on = session.read_field(segmentation);
  const DistributedGradient found = session.find(
      structure, on.mesh.local(), discrete_gradient_relations,
      [&](Structure& local) { return find_discrete_gradient(local, on.order, session.sweep()); },
      [&] { return find_discrete_gradient(WorkerSpace(), on.order, structure.device_sweep()); });
  tell_simplices({found.counts.begin(), found.counts.end()}, session.console(), session.report());
  session.finish(on.mesh);
}

}  // namespace gale::app
