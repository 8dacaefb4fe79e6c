#include <gale/relations/host_producer.hpp>

#include <algorithm>
#include <vector>

#include <gale/relations/star_kernel.hpp>

namespace gale {

namespace {

/// Memory that is thrown away when it has to grow, never copied, and never initialized.
template <class T>
class Buffer {
 public:
  T* data() { return data_.get(); }
  std::size_t size() const { return size_; }
  void reserve(std::size_t size) {
    if (size <= size_) return;
    size_ = size + size / 2;
    data_.reset(new T[size_]);
  }

 private:
  std::unique_ptr<T[]> data_;
  std::size_t size_ = 0;
};

StarSizes larger(const StarSizes& a, const StarSizes& b) {
  return {std::max(a.rows, b.rows), std::max(a.star, b.star), std::max(a.neighbours, b.neighbours), std::max(a.slots, b.slots)};
}

}  // namespace

struct HostProducer::Workspace {
  Mesh mesh;
  StarKernel<HostMemory> kernel;
  Buffer<char> scratch;
  Buffer<Id> pool;
  std::vector<Offset> directory;
  Id segment = 0;
  Offset used = 0;
  StarSizes needed;

  Workspace(const Mesh& given, RelationSet wanted) : mesh(given), directory(wanted.count()) {
    kernel.mesh = mesh.host();
    kernel.wanted = wanted;
    kernel.sizes = {128, 4096, 2048, 256};
    kernel.segments = &segment;
    kernel.pool.used = &used;
    kernel.pool.directory = directory.data();
    kernel.pool.needed = &needed;
    grow(std::size_t(1) << 14);
  }

  void grow(std::size_t words) {
    scratch.reserve(detail::StarScratch::bytes(kernel.sizes, 1));
    pool.reserve(words);
    kernel.pool.words = pool.data();
    kernel.pool.capacity = static_cast<Offset>(pool.size());
  }

  bool run() {
    used = 0;
    needed = StarSizes{};
    kernel(HostTeam(0, scratch.data(), scratch.size()));
    return std::find(directory.begin(), directory.end(), BlockPool::missing) == directory.end();
  }
};

HostProducer::HostProducer(const Mesh& mesh, RelationSet wanted) : workspace_(new Workspace(mesh, wanted)) {}
HostProducer::~HostProducer() = default;
HostProducer::HostProducer(HostProducer&&) noexcept = default;
HostProducer& HostProducer::operator=(HostProducer&&) noexcept = default;

SegmentRows HostProducer::compute(Id segment) {
  auto& work = *workspace_;
  work.segment = segment;
  while (!work.run()) {
    work.kernel.sizes = larger(work.kernel.sizes, work.needed);
    work.grow(work.used);
  }
  SegmentRows rows(segment, work.mesh.vertex_begin()(segment), work.mesh.vertex_begin()(segment + 1));
  const Offset* entry = work.directory.data();
  for (const Relation relation : members_of(work.kernel.wanted)) rows.set(relation, work.pool.data() + *entry++);
  return rows;
}

}  // namespace gale
