#pragma once

#include <memory>
#include <mutex>

#include <gale/runtime/options.hpp>
#include <gale/runtime/statistics.hpp>
#include <gale/runtime/structure.hpp>

namespace gale::detail {

/// What a Runtime is inside: one way of computing, each with a room of its own. See Runtime for what its functions do.
class RuntimeImplementation {
 public:
  virtual ~RuntimeImplementation() = default;
  virtual void for_each_segment(RelationSet wanted, const SweepOptions& options,
                                const Structure::SegmentBody& body) = 0;
  virtual std::unique_ptr<Consumer> consumer() = 0;
  virtual Way way() const = 0;
  virtual RuntimeStatistics statistics() const = 0;

  const Mesh& mesh() const { return mesh_; }
  RelationSet relations() const { return relations_; }

 protected:
  RuntimeImplementation(const Mesh& mesh, RelationSet relations) : mesh_(mesh), relations_(relations) {}

 private:
  Mesh mesh_;
  RelationSet relations_;
};

/// Way::inline_.
std::unique_ptr<RuntimeImplementation> by_consumers(const Mesh& mesh, RelationSet relations);

/// Way::helpers.
std::unique_ptr<RuntimeImplementation> by_helpers(const Mesh& mesh, RelationSet relations,
                                                  const RuntimeOptions& options);

/// Way::task_parallel.
std::unique_ptr<RuntimeImplementation> by_pairs(const Mesh& mesh, RelationSet relations);

/// Way::leaders.
std::unique_ptr<RuntimeImplementation> by_leaders(const Mesh& mesh, RelationSet relations,
                                                  const RuntimeOptions& options);

/// The statistics of consumers that have ended. Thread-safe.
class ConsumerLog {
 public:
  void add(const ConsumerStatistics& one) {
    const std::lock_guard<std::mutex> lock(mutex_);
    ended_.push_back(one);
  }
  std::vector<ConsumerStatistics> all() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return ended_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<ConsumerStatistics> ended_;
};

}  // namespace gale::detail
