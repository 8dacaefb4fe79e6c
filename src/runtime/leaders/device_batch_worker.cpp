#include <gale/base/error.hpp>
#include <gale/runtime/leaders/batch_worker.hpp>

#if defined(KOKKOS_ENABLE_CUDA)

#include <algorithm>
#include <atomic>

#include <gale/base/device.hpp>
#include <gale/base/transfer.hpp>
#include <gale/relations/kernels/segment_kernel.hpp>
#include <gale/runtime/device/launch_batch.hpp>

namespace gale::detail {

namespace {

template <class T>
using OnDevice = Array<T, WorkerMemory>;
template <class T>
using Pinned = PinnedArray<T>;

/// What a batch tells the host beside its blocks.
struct Header {
  Offset used = 0;
  StarSizes needed;
};

/// A batch on its own execution-space instance. Its memory is taken once, and again only when a batch needs more.
class DeviceBatchWorker : public BatchWorker {
 public:
  DeviceBatchWorker(const Mesh& mesh, const WorkerParameters& parameters)
      : mesh_(mesh),
        relations_(parameters.wanted.count()),
        instance_(make_instance()),
        kernel_(mesh, parameters.wanted),
        bounds_(segment_bounds(mesh, kernel_, parameters.threads_per_segment)),
        header_(allocate<OnDevice<Header>>("GALE::batch_header", 1)),
        header_copy_(1) {
    task_.pool.used = &header_.data()->used;
    task_.pool.needed = &header_.data()->needed;
    reserve(parameters.words);
  }

  void launch(const std::vector<Id>& segments, Offset words, const StarSizes& scratch) override {
    reserve(words);
    const std::size_t count = segments.size();
    reserve_segments(count);
    count_ = count;
    const auto is_large = [&](Id segment) { return bounds_->is_large[segment] != 0; };
    const LaunchOrder order = LaunchOrder::of(segments, is_large);
    std::copy(order.segments.begin(), order.segments.end(), segments_copy_.data());
    *header_copy_.data() = Header();
    Kokkos::deep_copy(instance_, header_, header_copy_.view());
    Kokkos::deep_copy(instance_, first_of(segments_, count), first_of(segments_copy_.view(), count));
    launch_batch(instance_, kernel_, *bounds_, task_, order, static_cast<Id>(count), scratch);
    Kokkos::deep_copy(instance_, header_copy_.view(), header_);
    Kokkos::deep_copy(instance_, first_of(directory_copy_.view(), count * relations_),
                      first_of(directory_, count * relations_));
  }

  void begin_copy(Arena& arena) override {
    instance_.fence("GALE::batch_computed");
    const auto words = static_cast<std::size_t>(std::min(header_copy_.data()->used, task_.pool.capacity));
    Kokkos::deep_copy(instance_, first_of(arena.words.view(), words), first_of(words_, words));
  }

  Shortfall finish(Arena& arena) override {
    const Header header = *header_copy_.data();
    arena.segments.assign(segments_copy_.data(), segments_copy_.data() + count_);
    arena.directory.assign(directory_copy_.data(), directory_copy_.data() + count_ * relations_);
    instance_.fence("GALE::batch_copied");
    const bool there = are_there(arena.batch(kernel_.wanted(), {}));
    return {!there, header.used, header.needed};
  }

  void abandon() noexcept override {
    try {
      instance_.fence("GALE::batch_abandoned");
    } catch (...) {
      // What is wrong with the device, the next launch will say.
    }
  }

  std::size_t device_bytes() const override { return device_bytes_; }

 private:
  void reserve(Offset words) {
    task_.pool.capacity = words;
    if (static_cast<Offset>(words_.extent(0)) >= words) return;
    task_.pool.words = nullptr;
    words_ = OnDevice<Id>();
    words_ = allocate<OnDevice<Id>>("GALE::batch_words", words);
    task_.pool.words = words_.data();
    device_bytes_ = words * sizeof(Id);
  }

  void reserve_segments(std::size_t count) {
    if (segments_.extent(0) >= count) return;
    // All or none: a batch that doesn't fit is tried again in parts.
    const auto segments = allocate<OnDevice<Id>>("GALE::batch_segments", count);
    const auto directory = allocate<OnDevice<Offset>>("GALE::batch_directory", count * relations_);
    segments_copy_ = Pinned<Id>(count);
    directory_copy_ = Pinned<Offset>(count * relations_);
    segments_ = segments;
    directory_ = directory;
    task_.segments = segments_.data();
    task_.pool.directory = directory_.data();
  }

  Mesh mesh_;
  std::size_t relations_;
  WorkerSpace instance_;
  SegmentKernel<WorkerMemory> kernel_;
  const std::shared_ptr<const SegmentBounds> bounds_;
  OnDevice<Header> header_;
  Pinned<Header> header_copy_;
  OnDevice<Id> segments_, words_;
  Pinned<Id> segments_copy_;
  OnDevice<Offset> directory_;
  Pinned<Offset> directory_copy_;
  KernelTask task_;
  std::atomic<std::size_t> device_bytes_{0};  ///< of words, which outweigh the rest
  std::size_t count_ = 0;
};

}  // namespace

std::unique_ptr<BatchWorker> make_device_worker(const Mesh& mesh, const WorkerParameters& parameters) {
  return std::make_unique<DeviceBatchWorker>(mesh, parameters);
}

}  // namespace gale::detail

#else

namespace gale::detail {

std::unique_ptr<BatchWorker> make_device_worker(const Mesh&, const WorkerParameters&) {
  throw Error("this Kokkos has no device");
}

}  // namespace gale::detail

#endif
