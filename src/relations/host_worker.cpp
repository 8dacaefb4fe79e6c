#include <algorithm>
#include <vector>

#include <gale/relations/host_worker.hpp>
#include <gale/relations/kernels/segment_kernel.hpp>

namespace gale {

/// One kernel on the calling thread: its scratch memory, and the blocks that it made last, in turn.
class HostWorker::Kernel {
 public:
  Kernel(const Mesh& mesh, RelationSet wanted, int kept)
      : kernel_(mesh, wanted), directory_(wanted.count()), buffers_(std::max(kept, 1)) {
    batch_.relations = wanted;
    batch_.count = 1;
    batch_.segments = &segment_;
    batch_.directory = directory_.data();
    batch_.intervals = interval_tables(mesh);
    for (Buffer& buffer : buffers_) grow(buffer, Offset(1) << 14);
  }
  Kernel(const Kernel&) = delete;
  Kernel& operator=(const Kernel&) = delete;

  /// Runs the kernel, again with more memory if it lacked some.
  Computed compute(Id segment) {
    Buffer& buffer = buffers_[next_++ % buffers_.size()];
    segment_ = segment;
    require_scratch(kernel_.bound(segment));
    for (;;) {
      StarSizes needed;
      Offset used = 0;
      const BlockPool pool{buffer.words.get(), buffer.capacity, &used, directory_.data(), &needed};
      kernel_.run({&segment_, sizes_, 0, pool}, scratch_.get());
      batch_.words = buffer.words.get();
      if (!sizes_.contains(needed)) {
        require_scratch(needed);
      } else if (are_there(batch_)) {
        return {batch_, used};
      } else {
        grow(buffer, used);
      }
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

  // Both may throw: the old memory serves the old sizes then.

  static void grow(Buffer& buffer, Offset count) {
    const Offset capacity = count + count / 2;
    buffer.words.reset(new Id[capacity]);
    buffer.capacity = capacity;
  }

  void require_scratch(const StarSizes& sizes) {
    if (scratch_ && sizes_.contains(sizes)) return;
    const StarSizes all = larger(sizes_, sizes);
    scratch_.reset(new char[kernel_.scratch_bytes(all, 1)]);
    sizes_ = all;
  }

  SegmentKernel<HostMemory> kernel_;
  StarSizes sizes_;
  std::unique_ptr<char[]> scratch_;
  std::vector<Offset> directory_;
  std::vector<Buffer> buffers_;
  std::size_t next_ = 0;
  Id segment_ = no_id;
  Batch<HostMemory> batch_;
};

HostWorker::HostWorker(const Mesh& mesh, RelationSet wanted, int kept) : mesh_(mesh) {
  for (const RelationSet one : kernels_for(wanted)) kernels_.push_back(std::make_unique<Kernel>(mesh, one, kept));
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
  for (const auto& kernel : kernels_) add_rows(kernel->compute(rows.segment()).batch, 0, rows);
}

HostWorker::Computed HostWorker::compute_batch(Id segment) { return kernels_.front()->compute(segment); }

std::size_t HostWorker::block_bytes() const {
  std::size_t sum = 0;
  for (const auto& kernel : kernels_) sum += kernel->block_bytes();
  return sum;
}

}  // namespace gale
