#include <algorithm>

#include <gale/relations/host_worker.hpp>
#include <gale/relations/kernels/block_pool.hpp>
#include <gale/runtime/leaders/batch_worker.hpp>

namespace gale::detail {

namespace {

class HostBatchWorker : public BatchWorker {
 public:
  HostBatchWorker(const Mesh& mesh, const WorkerParameters& parameters)
      : worker_(mesh, parameters.wanted), relations_(parameters.wanted.count()) {}

  void launch(const std::vector<Id>& segments, Offset, const StarSizes&) override { segments_ = segments; }

  void begin_copy(Arena&) override {}

  Shortfall finish(Arena& arena) override {
    arena.segments = segments_;
    arena.directory.assign(segments_.size() * relations_, BlockPool::missing);
    const auto capacity = static_cast<Offset>(arena.words.size());
    Offset used = 0;
    for (std::size_t slot = 0; slot < segments_.size(); ++slot) {
      const HostWorker::Computed computed = worker_.compute_batch(segments_[slot]);
      if (used + computed.words <= capacity) {
        std::copy_n(computed.batch.words, computed.words, arena.words.data() + used);
        for (std::size_t i = 0; i < relations_; ++i) {
          arena.directory[slot * relations_ + i] = used + computed.batch.directory[i];
        }
      }
      used += computed.words;
    }
    return {used > capacity, used, {}};
  }

  void abandon() noexcept override { segments_.clear(); }
  std::size_t device_bytes() const override { return 0; }

 private:
  HostWorker worker_;
  std::size_t relations_;
  std::vector<Id> segments_;
};

}  // namespace

std::unique_ptr<BatchWorker> make_host_worker(const Mesh& mesh, const WorkerParameters& parameters) {
  return std::make_unique<HostBatchWorker>(mesh, parameters);
}

}  // namespace gale::detail
