#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include <gale/export.hpp>
#include <gale/relations/relation.hpp>

namespace gale {

/// Seconds that a consumer waited, by the stages that its requests went through.
struct GALE_EXPORT WaitingTimes {
  double push = 0;                 ///< to put the request on the queue
  double queue = 0;                ///< until the leader took it
  double preparation = 0;          ///< until its batch was launched
  double kernel_and_transfer = 0;  ///< until the blocks were on the host
  double integration = 0;          ///< until the consumer had its block

  /// All stages together.
  double total() const { return push + queue + preparation + kernel_and_transfer + integration; }

  /// Adds another's seconds, stage by stage.
  WaitingTimes& operator+=(const WaitingTimes& other);
};

/// What one consumer did.
struct GALE_EXPORT ConsumerStatistics {
  std::int64_t hits = 0;               ///< blocks that were there already
  std::int64_t requests = 0;           ///< blocks that it waited for
  WaitingTimes waiting;                ///< how long it waited for these
  std::int64_t segments_computed = 0;  ///< by itself
  double seconds_computing = 0;        ///< spent on these

  /// Adds what another did.
  ConsumerStatistics& operator+=(const ConsumerStatistics& other);
};

/// What cores that sweeps left idle did ahead of the consumers.
struct GALE_EXPORT HelperStatistics {
  std::int64_t segments_computed = 0;  ///< by all helpers
  double seconds_computing = 0;        ///< spent on these

  /// Adds what others did.
  HelperStatistics& operator+=(const HelperStatistics& other);
};

/// How many requests a leader found waiting, each time that it found any.
struct GALE_EXPORT QueueLengths {
  std::vector<std::int64_t> times;  ///< by length

  void add(std::size_t length);  ///< counts one more time
  double mean() const;           ///< 0 where it never found any
  double deviation() const;      ///< the standard deviation
  std::int64_t median() const;   ///< the lower one of two
};

/// What one queue's leader did.
struct LeaderStatistics {
  RelationSet relations;                 ///< what its batches compute
  std::int64_t batches = 0;              ///< how many were launched
  std::int64_t segments_computed = 0;    ///< in all batches
  std::int64_t segments_recomputed = 0;  ///< how many of these it had computed before
  std::int64_t segments_on_host = 0;     ///< how many of these the host computed since the device lacked memory
  std::int64_t bytes = 0;                ///< all blocks together
  std::int64_t blocks_evicted = 0;       ///< blocks whose place others took
  std::int64_t batches_split = 0;        ///< batches that didn't fit, and were tried again in parts
  QueueLengths queue_lengths;            ///< requests that it found waiting
};

/// Everything since a structure was made.
struct GALE_EXPORT StructureStatistics {
  std::vector<ConsumerStatistics> consumers;  ///< one for each that has ended; a sweep's consumers by their number
  HelperStatistics helpers;               ///< in all sweeps; a block of theirs that a consumer read is one of its hits
  std::vector<LeaderStatistics> leaders;  ///< one for each queue
  std::size_t host_bytes = 0;             ///< allocated for blocks on the host, at most at one time
  std::size_t device_bytes = 0;           ///< allocated for batches on the device
  std::vector<std::string> notices;       ///< one line each about what it did differently than asked for, and why

  /// The sum over all consumers.
  ConsumerStatistics all_consumers() const;
};

namespace detail {

/// Adds the time from its construction to its end to `seconds`.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds), begin_(std::chrono::steady_clock::now()) {}
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point begin_;
};

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

}  // namespace detail

}  // namespace gale
