#include <algorithm>

#include <gale/relations/kernels/segment_kernel.hpp>
#include <gale/relations/preconditioning.hpp>
#include <gale/runtime/defaults.hpp>
#include <gale/runtime/leaders/leaders.hpp>

namespace gale::detail {

namespace {

/// One computes, another's blocks are copied, and those of the third are published.
constexpr int workers_per_leader = 3;

std::vector<RelationSet> queues_for(RelationSet relations, Queues queues) {
  if (queues == Queues::per_kernel) return kernels_for(relations);
  const auto members = members_of(relations);
  std::vector<RelationSet> each(members.begin(), members.end());
  if (relations.has_links()) each.push_back(link_form);
  return each;
}

std::unique_ptr<Leader> make_leader(const Mesh& mesh, RelationSet relations, const Sizes& sizes) {
  const WorkerParameters worker{relations, sizes.batch_words, sizes.threads_per_segment};
  LeaderParameters leader{relations, sizes.batch_words, sizes.host_bytes, sizes.segments_per_request, {}};
  std::vector<std::unique_ptr<BatchWorker>> workers;
  if (mesh.on_device()) leader.make_host_worker = [mesh, worker] { return make_host_worker(mesh, worker); };
  for (int i = 0; i < workers_per_leader; ++i) {
    workers.push_back(mesh.on_device() ? make_device_worker(mesh, worker) : make_host_worker(mesh, worker));
  }
  return std::make_unique<Leader>(mesh, leader, std::move(workers));
}

}  // namespace

Leaders::Leaders(const Mesh& mesh, RelationSet relations, const StructureOptions& options)
    : mesh_(mesh), relations_(relations) {
  mesh.simplices(needs_of(relations & face_relations));
  const auto queues = queues_for(relations - face_relations, options.queues);
  const Sizes sizes = sizes_for(mesh, options, std::max(static_cast<int>(queues.size()), 1));
  for (const RelationSet members : queues) leaders_.push_back(make_leader(mesh, members, sizes));
}

Leader& Leaders::of(RelationSet one) const {
  const auto has = [one](const auto& leader) { return leader->relations().contains(one); };
  return **std::find_if(leaders_.begin(), leaders_.end(), has);
}

std::vector<Leader*> Leaders::some_of(RelationSet wanted) const {
  std::vector<Leader*> some;
  for (const auto& leader : leaders_) {
    if (!(leader->relations() & wanted).empty()) some.push_back(leader.get());
  }
  return some;
}

void Leaders::end() {
  for (const auto& leader : leaders_) leader->end();
}

}  // namespace gale::detail
