#include <vector>

#include <gale/relations/host_worker.hpp>
#include <gale/relations/host_workspace.hpp>

namespace gale {

namespace {

/// One kernel, and the memory of the blocks that it made last, in turn.
class Blocks {
 public:
  Blocks(const Mesh& mesh, RelationSet wanted, int kept)
      : kernel_(mesh, wanted), relations_(members_of(wanted)), directory_(relations_.size()), buffers_(kept) {
    pool_.used = &used_;
    pool_.directory = directory_.data();
    for (Buffer& buffer : buffers_) grow(buffer, Offset(1) << 14);
  }
  Blocks(const Blocks&) = delete;
  Blocks& operator=(const Blocks&) = delete;

  void compute(SegmentRows& rows) {
    Buffer& buffer = buffers_[next_++ % buffers_.size()];
    for (;;) {
      used_ = 0;
      pool_.words = buffer.words.get();
      pool_.capacity = buffer.capacity;
      if (kernel_.compute(rows.segment(), pool_)) break;
      grow(buffer, used_);
    }
    const Offset* entry = directory_.data();
    for (const Relation relation : relations_) rows.set(relation, pool_.words + *entry++);
  }

  std::size_t bytes() const {
    std::size_t sum = 0;
    for (const Buffer& buffer : buffers_) sum += static_cast<std::size_t>(buffer.capacity) * sizeof(Id);
    return sum;
  }

 private:
  struct Buffer {
    std::unique_ptr<Id[]> words;
    Offset capacity = 0;
  };

  static void grow(Buffer& buffer, Offset count) {
    const Offset capacity = count + count / 2;
    buffer.words.reset(new Id[capacity]);  // may throw: the old memory serves the old capacity then
    buffer.capacity = capacity;
  }

  detail::HostWorkspace kernel_;
  std::vector<Relation> relations_;
  std::vector<Offset> directory_;
  std::vector<Buffer> buffers_;
  std::size_t next_ = 0;
  Offset used_ = 0;
  BlockPool pool_;
};

}  // namespace

struct HostWorker::Workspace {
  Mesh mesh;
  std::vector<std::unique_ptr<Blocks>> kernels;

  Workspace(const Mesh& given, RelationSet wanted, int kept) : mesh(given) {
    for (const RelationSet one : kernels_for(wanted)) kernels.push_back(std::make_unique<Blocks>(mesh, one, kept));
  }
};

HostWorker::HostWorker(const Mesh& mesh, RelationSet wanted, int kept)
    : workspace_(new Workspace(mesh, wanted, kept)) {}
HostWorker::~HostWorker() = default;
HostWorker::HostWorker(HostWorker&&) noexcept = default;
HostWorker& HostWorker::operator=(HostWorker&&) noexcept = default;

SegmentRows HostWorker::compute(Id segment) {
  SegmentRows rows(segment, workspace_->mesh.intervals_of(segment));
  compute(rows);
  return rows;
}

void HostWorker::compute(SegmentRows& rows) {
  for (const auto& kernel : workspace_->kernels) kernel->compute(rows);
}

std::size_t HostWorker::block_bytes() const {
  std::size_t sum = 0;
  for (const auto& kernel : workspace_->kernels) sum += kernel->bytes();
  return sum;
}

}  // namespace gale
