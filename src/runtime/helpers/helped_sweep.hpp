#pragma once

#include <algorithm>
#include <vector>

#include <gale/runtime/helpers/helper.hpp>

namespace gale::detail {

/// The consumers of a sweep, and the helpers that run ahead of them. Consumers take what helpers have ready, and else
/// compute.
class HelpedSweep {
 public:
  /// With fewer helpers if there are no more threads to be had. Consumers compute with what `make` makes, helpers with
  /// what `make_for_helper` does.
  HelpedSweep(Id segments, int consumers, const MakeWorker& make, int helpers, const MakeWorker& make_for_helper,
              std::size_t budget_of_each)
      : make_(make), unbegun_(segments), consumers_(consumers) {
    try {
      while (helpers-- > 0) helpers_.push_back(std::make_unique<Helper>(make_for_helper, unbegun_, budget_of_each));
    } catch (const std::exception&) {
    }
  }

  /// Calls body(rows) for some segment. At most as often as there are segments, by the consumer of that number.
  template <class Body>
  void read_next(int number, const Body& body) {
    auto& consumer = consumers_[number];
    if (!consumer) consumer = std::make_unique<SweepConsumer>(make_);
    const auto hit = [&](const SegmentRows& rows) {
      ++consumer->statistics.hits;
      body(rows);
    };
    while (!any_helper(number, [&](Helper& helper) { return helper.lend(hit); })) {
      Id segment = unbegun_.take();
      if (segment == no_id) any_helper(number, [&](Helper& helper) { return (segment = helper.take_away()) != no_id; });
      if (segment != no_id) return body(consumer->worker->compute(segment));
      std::this_thread::yield();  // a helper is just handing over the last one
    }
  }

  /// Waits for the helpers to end, when all segments are read.
  void end() {
    for (const auto& helper : helpers_) helper->end();
  }

  // After end().
  std::vector<ConsumerStatistics> of_consumers() const {
    std::vector<ConsumerStatistics> all;
    for (const auto& one : consumers_) all.push_back(one ? one->statistics : ConsumerStatistics());
    return all;
  }
  HelperStatistics of_helpers() const {
    HelperStatistics all;
    for (const auto& helper : helpers_) {
      all.segments_computed += helper->statistics().segments_computed;
      all.seconds_computing += helper->statistics().seconds_computing;
    }
    return all;
  }
  std::size_t block_bytes() const {
    std::size_t sum = 0;
    for (const auto& helper : helpers_) sum += helper->block_bytes();
    return sum;
  }

 private:
  struct SweepConsumer {
    ConsumerStatistics statistics;
    std::unique_ptr<SegmentWorker> worker;

    explicit SweepConsumer(const MakeWorker& make) : worker(make(statistics, 1)) {}
  };

  /// Asks helpers until one says yes; each consumer begins with another.
  template <class Ask>
  bool any_helper(int consumer, const Ask& ask) {
    const std::size_t count = helpers_.size();
    for (std::size_t i = 0; i < count; ++i) {
      if (ask(*helpers_[(consumer + i) % count])) return true;
    }
    return false;
  }

  const MakeWorker make_;
  UnbegunSegments unbegun_;
  std::vector<std::unique_ptr<SweepConsumer>> consumers_;
  std::vector<std::unique_ptr<Helper>> helpers_;
};

}  // namespace gale::detail
