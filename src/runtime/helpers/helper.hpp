#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <thread>

#include <gale/runtime/helpers/segment_worker.hpp>

namespace gale::detail {

/// The segments of a sweep that nobody has begun: dealt out one by one, ascending, to whoever computes them.
class UnbegunSegments {
 public:
  explicit UnbegunSegments(Id segments) : segments_(segments) {}

  /// no_id when there are none any more.
  Id take() {
    const Offset next = next_.fetch_add(1);
    return next < segments_ ? static_cast<Id>(next) : no_id;
  }

 private:
  const Id segments_;
  std::atomic<Offset> next_{0};
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

}  // namespace gale::detail
