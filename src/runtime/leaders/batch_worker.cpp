#include <gale/runtime/batches/batch_lane.hpp>
#include <gale/runtime/batches/host_worker.hpp>
#include <gale/runtime/leaders/batch_worker.hpp>

namespace gale::detail {

namespace {

class HostBatchWorker : public BatchWorker {
 public:
  HostBatchWorker(const Mesh& mesh, const WorkerParameters& parameters) : kernel_(mesh, parameters.wanted) {}

  void launch(const BatchPlan& plan) override { plan_ = plan; }
  void begin_copy(Arena&) override {}

  BatchShortfall finish(Arena& arena) override {
    const std::size_t relations = kernel_.wanted().count();
    arena.segments.resize(plan_.count());
    arena.directory.assign(arena.segments.size() * relations, BlockPool::missing);
    BatchShortfall lacked;
    for (std::size_t slot = 0; slot < arena.segments.size(); ++slot) {
      const Id segment = arena.segments[slot] = plan_.segment(static_cast<Id>(slot));
      Offset* const directory = arena.directory.data() + slot * relations;
      kernel_.run(segment, {arena.words.data(), plan_.words, &lacked.words, directory, nullptr});
      if (!are_there({kernel_.wanted(), 1, &segment, directory, nullptr, {}})) lacked.segments.push_back(segment);
    }
    return lacked;
  }

  void abandon() noexcept override {}
  std::size_t device_bytes() const override { return 0; }

 private:
  HostKernel kernel_;
  BatchPlan plan_;
};

template <class Memory>
class LaunchedWorker : public BatchWorker {
 public:
  using Kernels = typename BatchLane<Memory>::Kernels;

  LaunchedWorker(const Mesh& mesh, std::shared_ptr<Kernels> kernels, const WorkerParameters& parameters)
      : relations_(parameters.wanted.count()),
        lane_(mesh, std::move(kernels), parameters.words, BatchReader::host),
        device_bytes_(lane_.bytes()) {}

  void launch(const BatchPlan& plan) override {
    lane_.launch(plan);
    device_bytes_ = lane_.bytes();
  }

  void begin_copy(Arena& arena) override { lane_.begin_copy(arena.words); }

  BatchShortfall finish(Arena& arena) override {
    const Id count = lane_.plan().count();
    arena.segments.resize(count);
    for (Id slot = 0; slot < count; ++slot) arena.segments[slot] = lane_.segment(slot);
    arena.directory.assign(lane_.directory(), lane_.directory() + count * relations_);
    return lane_.finish();
  }

  void abandon() noexcept override { lane_.abandon(); }
  std::size_t device_bytes() const override { return is_device_memory<Memory> ? device_bytes_.load() : 0; }

 private:
  const Offset relations_;
  BatchLane<Memory> lane_;
  std::atomic<std::size_t> device_bytes_;  ///< of words, which outweigh the rest
};

}  // namespace

std::unique_ptr<BatchWorker> make_host_worker(const Mesh& mesh, const WorkerParameters& parameters) {
  return std::make_unique<HostBatchWorker>(mesh, parameters);
}

template <class Memory>
std::unique_ptr<BatchWorker> make_launched_worker(const Mesh& mesh, const WorkerParameters& parameters) {
  auto kernels = std::make_shared<typename BatchLane<Memory>::Kernels>();
  kernels->emplace_back(mesh, parameters.wanted, parameters.threads_per_segment);
  return std::make_unique<LaunchedWorker<Memory>>(mesh, std::move(kernels), parameters);
}

#define GALE_INSTANTIATE(Space) \
  template std::unique_ptr<BatchWorker> make_launched_worker<MemoryOf<Space>>(const Mesh&, const WorkerParameters&)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
