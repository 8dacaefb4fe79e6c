#include <algorithm>

#include <gale/relations/host_workspace.hpp>
#include <gale/runtime/leaders/batch_worker.hpp>

namespace gale::detail {

namespace {

class HostBatchWorker : public BatchWorker {
 public:
  HostBatchWorker(const Mesh& mesh, const WorkerParameters& parameters)
      : mesh_(mesh), workspace_(mesh, parameters.wanted), relations_(parameters.wanted.count()) {}

  bool is_large(Id) const override { return false; }
  void launch(const std::vector<Id>& segments, Offset, const StarSizes&) override { segments_ = segments; }

  void begin_copy(Arena&) override {}

  Shortfall finish(Arena& arena) override {
    arena.segments = segments_;
    arena.directory.assign(segments_.size() * relations_, BlockPool::missing);
    Offset used = 0;
    BlockPool pool;
    pool.words = arena.words.data();
    pool.capacity = static_cast<Offset>(arena.words.size());
    pool.used = &used;
    bool missing = false;
    for (std::size_t slot = 0; slot < segments_.size(); ++slot) {
      pool.directory = arena.directory.data() + slot * relations_;
      missing |= !workspace_.compute(segments_[slot], pool);
    }
    return {missing, used, {}};
  }

  void abandon() noexcept override { segments_.clear(); }
  std::size_t device_bytes() const override { return 0; }

 private:
  Mesh mesh_;
  HostWorkspace workspace_;
  std::size_t relations_;
  std::vector<Id> segments_;
};

}  // namespace

std::unique_ptr<BatchWorker> make_host_worker(const Mesh& mesh, const WorkerParameters& parameters) {
  return std::make_unique<HostBatchWorker>(mesh, parameters);
}

}  // namespace gale::detail
