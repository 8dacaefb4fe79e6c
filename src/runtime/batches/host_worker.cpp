#include <algorithm>

#include <gale/runtime/batches/host_worker.hpp>

namespace gale {

void detail::HostKernel::run(Id segment, const BlockPool& pool) {
  require_scratch(kernel_.bound(segment));
  const Offset used = *pool.used;
  for (;;) {
    StarSizes needed;
    BlockPool own = pool;
    own.needed = &needed;
    kernel_.run({&segment, sizes_, 0, own}, scratch_.get());
    if (sizes_.contains(needed)) return;
    *pool.used = used;
    require_scratch(needed);
  }
}

/// May throw: the old memory serves the old sizes then.
void detail::HostKernel::require_scratch(const StarSizes& sizes) {
  if (scratch_ && sizes_.contains(sizes)) return;
  const StarSizes all = larger(sizes_, sizes);
  scratch_.reset(new char[kernel_.scratch_bytes(all, 1)]);
  sizes_ = all;
}

/// One kernel, and the blocks that it made last, in turn.
class HostWorker::BlockMaker {
 public:
  BlockMaker(const Mesh& mesh, RelationSet wanted, int kept)
      : kernel_(mesh, wanted), directory_(wanted.count()), buffers_(std::max(kept, 1)) {
    batch_.relations = wanted;
    batch_.count = 1;
    batch_.segments = &segment_;
    batch_.directory = directory_.data();
    batch_.intervals = interval_tables(mesh);
    for (Buffer& buffer : buffers_) grow(buffer, Offset(1) << 14);
  }
  BlockMaker(const BlockMaker&) = delete;
  BlockMaker& operator=(const BlockMaker&) = delete;

  /// Runs the kernel, again with more room if it lacked some.
  const Batch<HostMemory>& make(Id segment) {
    Buffer& buffer = buffers_[next_++ % buffers_.size()];
    segment_ = segment;
    for (;;) {
      Offset used = 0;
      kernel_.run(segment, {buffer.words.get(), buffer.capacity, &used, directory_.data(), nullptr});
      batch_.words = buffer.words.get();
      if (are_there(batch_)) return batch_;
      grow(buffer, used);
    }
  }

  std::size_t block_bytes() const {
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
    buffer.words.reset(new Id[capacity]);
    buffer.capacity = capacity;
  }

  detail::HostKernel kernel_;
  std::vector<Offset> directory_;
  std::vector<Buffer> buffers_;
  std::size_t next_ = 0;
  Id segment_ = no_id;
  Batch<HostMemory> batch_;
};

HostWorker::HostWorker(const Mesh& mesh, RelationSet wanted, int kept) : mesh_(mesh) {
  for (const RelationSet one : kernels_for(wanted, mesh.dimension()))
    makers_.push_back(std::make_unique<BlockMaker>(mesh, one, kept));
}
HostWorker::~HostWorker() = default;
HostWorker::HostWorker(HostWorker&&) noexcept = default;
HostWorker& HostWorker::operator=(HostWorker&&) noexcept = default;

SegmentRows HostWorker::compute(Id segment) {
  SegmentRows rows(segment, mesh_.intervals_of(segment));
  compute(rows);
  return rows;
}

void HostWorker::compute(SegmentRows& rows) {
  for (const auto& maker : makers_) add_rows(maker->make(rows.segment()), 0, rows);
}

std::size_t HostWorker::block_bytes() const {
  std::size_t sum = 0;
  for (const auto& maker : makers_) sum += maker->block_bytes();
  return sum;
}

}  // namespace gale
