#include <algorithm>

#include <gale/base/kokkos.hpp>
#include <gale/runtime/structure.hpp>
#include <gale/runtime/sweep.hpp>

namespace gale {

Structure::Structure(const Mesh& mesh, RelationSet relations, Way way)
    : mesh_(mesh), relations_(relations), way_(way), log_(std::make_shared<detail::ConsumerLog>()) {}

Structure::~Structure() = default;

Id Structure::count(int dimension) const {
  switch (dimension) {
    case 0:
      return mesh_.vertices();
    case 1:
      return mesh_.known_edges();
    case 2:
      return mesh_.known_triangles();
    default:
      return mesh_.dimension() == 3 ? mesh_.cells() : 0;
  }
}

void Structure::for_each_segment(RelationSet wanted, const SweepOptions& options, const SegmentBody& body) {
  require_preconditioned(relations_, wanted);
  const SegmentBody untracked = [&body](int consumer, const SegmentRows& rows) {
    const detail::UntrackedViews views;
    body(consumer, rows);
  };
  const auto sweep = begin_sweep(wanted, std::max(options.threads, 0), untracked);
  detail::sweep(mesh_.owned_segments(), options,
                [&](int consumer, Id segment) { sweep->visit(consumer, segment, untracked); });
  sweep->end();
  for (const ConsumerStatistics& one : sweep->statistics) log_->add(one);
}

StructureStatistics Structure::statistics() const {
  StructureStatistics all;
  all.consumers = log_->all();
  if (!mesh_.notice().empty()) all.notices.push_back(mesh_.notice());
  all.notices.insert(all.notices.end(), notices_.begin(), notices_.end());
  add_statistics(all);
  return all;
}

}  // namespace gale
