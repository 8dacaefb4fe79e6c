#pragma once

#include <chrono>
#include <functional>
#include <memory>

#include <gale/relations/host_worker.hpp>
#include <gale/runtime/statistics.hpp>

namespace gale::detail {

/// Computes segments on one thread.
class SegmentWorker {
 public:
  virtual ~SegmentWorker() = default;
  virtual SegmentRows compute(Id segment) = 0;
  virtual std::size_t block_bytes() const = 0;  ///< allocated for blocks, now
};

/// Makes one that counts in the given statistics, and of which the blocks of the last `kept` segments stay valid.
using MakeWorker = std::function<std::unique_ptr<SegmentWorker>(ConsumerStatistics&, int kept)>;

/// A HostWorker that keeps count.
class CountingWorker final : public SegmentWorker {
 public:
  CountingWorker(const Mesh& mesh, RelationSet relations, ConsumerStatistics& statistics, int kept = 1)
      : worker_(mesh, relations, kept), statistics_(&statistics) {}

  SegmentRows compute(Id segment) override {
    const auto begin = std::chrono::steady_clock::now();
    const SegmentRows rows = worker_.compute(segment);
    statistics_->seconds_computing += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    ++statistics_->segments_computed;
    return rows;
  }

  std::size_t block_bytes() const override { return worker_.block_bytes(); }

 private:
  HostWorker worker_;
  ConsumerStatistics* statistics_;
};

}  // namespace gale::detail
