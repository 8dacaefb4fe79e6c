#include <gale/app/critical_counts.hpp>
#include <gale/app/ranks/complex_pieces.hpp>
#include <gale/app/ranks/rank_session.hpp>
#include <gale/app/ranks/ranks.hpp>
#include <gale/distributed/distributed_gradient.hpp>

namespace gale::app {

void discrete_gradient_on_ranks(const InputOptions& input, const CommonOptions& common,
                                const SegmentationOptions& segmentation, const StructureOption& structure,
                                const std::string& output) {
  RankSession session(input, common, {output});
  const FieldOnRanks on = session.read_field(segmentation);
  const DistributedGradient found = session.find_gradient(structure, on);
  tell_simplices({found.counts.begin(), found.counts.end()}, session.console(), session.report());
  if (!output.empty()) {
    const auto numbers = session.number(structure, on.mesh, named_simplices(found));
    session.write_pieces(output, to_point_set(on, found, numbers));
  }
  session.finish(on.mesh);
}

}  // namespace gale::app
