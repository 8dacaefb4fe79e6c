#include <gale/relations/host_producer.hpp>

#include <vector>

#include <gale/relations/detail/host_workspace.hpp>

namespace gale {

namespace {

/// One kernel, and the memory of the blocks that it made last.
class Blocks {
 public:
  Blocks(const Mesh& mesh, RelationSet wanted) : kernel_(mesh, wanted), relations_(members_of(wanted)), directory_(relations_.size()) {
    pool_.used = &used_;
    pool_.directory = directory_.data();
    grow(Offset(1) << 14);
  }
  Blocks(const Blocks&) = delete;
  Blocks& operator=(const Blocks&) = delete;

  void compute(SegmentRows& rows) {
    for (used_ = 0; !kernel_.compute(rows.segment(), pool_); used_ = 0) grow(used_);
    const Offset* entry = directory_.data();
    for (const Relation relation : relations_) rows.set(relation, pool_.words + *entry++);
  }

 private:
  void grow(Offset count) {
    const Offset capacity = count + count / 2;
    words_.reset(new Id[capacity]);  // may throw: the old memory serves the old capacity then
    pool_.words = words_.get();
    pool_.capacity = capacity;
  }

  detail::HostWorkspace kernel_;
  std::vector<Relation> relations_;
  std::unique_ptr<Id[]> words_;
  std::vector<Offset> directory_;
  Offset used_ = 0;
  BlockPool pool_;
};

}  // namespace

struct HostProducer::Workspace {
  Mesh mesh;
  std::vector<std::unique_ptr<Blocks>> kernels;

  Workspace(const Mesh& given, RelationSet wanted) : mesh(given) {
    for (const RelationSet one : kernels_for(wanted)) kernels.push_back(std::make_unique<Blocks>(mesh, one));
  }
};

HostProducer::HostProducer(const Mesh& mesh, RelationSet wanted) : workspace_(new Workspace(mesh, wanted)) {}
HostProducer::~HostProducer() = default;
HostProducer::HostProducer(HostProducer&&) noexcept = default;
HostProducer& HostProducer::operator=(HostProducer&&) noexcept = default;

SegmentRows HostProducer::compute(Id segment) {
  SegmentRows rows(segment, workspace_->mesh.intervals_of(segment));
  compute(rows);
  return rows;
}

void HostProducer::compute(SegmentRows& rows) {
  for (const auto& kernel : workspace_->kernels) kernel->compute(rows);
}

}  // namespace gale
