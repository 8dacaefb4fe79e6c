#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include <gale/runtime/ways.hpp>

namespace gale::detail {

/// What consumers and helpers of a sweep compute segments with: a HostWorker that keeps count. Tests put others in its
/// place.
class SegmentWorker {
 public:
  /// Counts in `statistics`, which must outlive it. The blocks of the last `kept` segments stay valid.
  SegmentWorker(const Mesh& mesh, RelationSet relations, ConsumerStatistics& statistics, int kept)
      : worker_(mesh, relations, kept), statistics_(statistics) {}
  virtual ~SegmentWorker() = default;

  virtual SegmentRows compute(Id segment) { return compute_counted(worker_, segment, statistics_); }

  /// Allocated for blocks, now.
  std::size_t block_bytes() const { return worker_.block_bytes(); }

 private:
  HostWorker worker_;
  ConsumerStatistics& statistics_;
};

/// Makes one.
using MakeWorker = std::function<std::unique_ptr<SegmentWorker>(ConsumerStatistics& statistics, int kept)>;

/// The segments of a sweep that nobody has begun: dealt out one by one, ascending, to whoever computes them.
class UnbegunSegments {
 public:
  explicit UnbegunSegments(const Interval& segments) : end_(segments.last), next_(segments.first) {}

  /// no_id when there are none any more.
  Id take() {
    const Offset next = next_.fetch_add(1);
    return next < end_ ? static_cast<Id>(next) : no_id;
  }

 private:
  const Id end_;
  std::atomic<Offset> next_;
};

/// A thread that computes segments of a sweep ahead of the consumers, into a ring of blocks. While the ring is full it
/// sleeps.
///
/// Nobody depends on it: a consumer that finds no other segment takes the one away that the helper is at, and computes
/// it. So no consumer waits for a helper that the system has put aside, and one that fails just leaves: whoever
/// computes that segment then has the same failure to tell, if it is one.
class Helper {
 public:
  /// Helps as long as its blocks take at most `budget` bytes. `unbegun` must outlive it.
  Helper(const MakeWorker& make, UnbegunSegments& unbegun, std::size_t budget);

  /// Ends after the segment that it is at.
  ~Helper();

  /// Calls body(rows) for the oldest segment that is ready; false if none is. By any consumer. A block whose body
  /// throws is never used again.
  template <class Body>
  bool lend(const Body& body) {
    std::uint64_t next = lent_.load();
    do {
      if (next == filled_.load()) return false;
    } while (!lent_.compare_exchange_weak(next, next + 1));
    const auto slot = next % slots;
    body(rows_[slot]);
    free_.fetch_or(1u << slot);
    return true;
  }

  /// The segment that it is at, which is the caller's from now on; no_id if there is none. By a consumer, once none are
  /// unbegun.
  Id take_away() { return under_way_.exchange(no_id); }

  /// Returns when the thread has ended, which it does once none are unbegun.
  void end();

  // After end().
  const ConsumerStatistics& statistics() const { return statistics_; }
  std::size_t block_bytes() const { return block_bytes_; }

 private:
  static constexpr int slots = 8;

  void run(const MakeWorker& make, UnbegunSegments& unbegun, std::size_t budget);
  bool wait_for_room(int slot) const;

  std::array<SegmentRows, slots> rows_;
  alignas(64) std::atomic<std::uint64_t> filled_{0};
  std::atomic<Id> under_way_{no_id};
  alignas(64) std::atomic<std::uint64_t> lent_{0};
  std::atomic<unsigned> free_{(1u << slots) - 1};  ///< a bit for each slot
  std::atomic<bool> stopping_{false};
  ConsumerStatistics statistics_;
  std::size_t block_bytes_ = 0;
  std::unique_ptr<SegmentWorker> worker_;  ///< outlives the thread: consumers read its blocks
  std::thread thread_;
};

/// The consumers of a sweep, and the helpers that run ahead of them. Consumers take what helpers have ready, and else
/// compute.
class HelpedSweep {
 public:
  /// Begins with fewer helpers if there are no more threads to be had. Consumers compute with what `make` makes,
  /// helpers with what `make_for_helper` does.
  HelpedSweep(const Interval& segments, int consumers, const MakeWorker& make, int helpers,
              const MakeWorker& make_for_helper, std::size_t budget_of_each)
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
