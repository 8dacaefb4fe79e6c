#pragma once

#include <functional>
#include <memory>
#include <vector>

#include <gale/runtime/leaders/batch_worker.hpp>

namespace gale::test {

/// A host worker with something done before it launches, and before it finishes.
class Interrupted : public detail::BatchWorker {
 public:
  using Interruption = std::function<void(const std::vector<Id>&)>;

  Interrupted(const Mesh& mesh, Interruption at_launch, Interruption at_finish)
      : worker_(detail::make_host_worker(mesh, {Relation::VV, 0, 32})),
        at_launch_(std::move(at_launch)),
        at_finish_(std::move(at_finish)) {}

  void launch(const detail::BatchPlan& plan) override {
    if (at_launch_) at_launch_(plan.segments);
    segments_ = plan.segments;
    worker_->launch(plan);
  }
  void begin_copy(detail::Arena& arena) override { worker_->begin_copy(arena); }
  detail::BatchShortfall finish(detail::Arena& arena) override {
    if (at_finish_) at_finish_(segments_);
    return worker_->finish(arena);
  }
  void abandon() noexcept override {}
  std::size_t device_bytes() const override { return 0; }

 private:
  std::unique_ptr<detail::BatchWorker> worker_;
  Interruption at_launch_, at_finish_;
  std::vector<Id> segments_;
};

}  // namespace gale::test
