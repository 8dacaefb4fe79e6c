#pragma once

#include <chrono>
#include <functional>
#include <memory>

#include <gale/relations/host_producer.hpp>
#include <gale/runtime/statistics.hpp>

namespace gale::detail {

/// Computes segments on one thread.
class SegmentProducer {
 public:
  virtual ~SegmentProducer() = default;
  virtual SegmentRows compute(Id segment) = 0;
  virtual std::size_t block_bytes() const = 0;  ///< allocated for blocks, now
};

/// Makes one that counts in the given statistics, and of which the blocks of the last `kept` segments stay valid.
using MakeProducer = std::function<std::unique_ptr<SegmentProducer>(ConsumerStatistics&, int kept)>;

/// A HostProducer that keeps count.
class CountingProducer final : public SegmentProducer {
 public:
  CountingProducer(const Mesh& mesh, RelationSet relations, ConsumerStatistics& statistics, int kept = 1)
      : producer_(mesh, relations, kept), statistics_(&statistics) {}

  SegmentRows compute(Id segment) override {
    const auto begin = std::chrono::steady_clock::now();
    const SegmentRows rows = producer_.compute(segment);
    statistics_->seconds_computing += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    ++statistics_->segments_computed;
    return rows;
  }

  std::size_t block_bytes() const override { return producer_.block_bytes(); }

 private:
  HostProducer producer_;
  ConsumerStatistics* statistics_;
};

}  // namespace gale::detail
