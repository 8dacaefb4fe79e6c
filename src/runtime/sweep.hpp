#pragma once

#include <algorithm>
#include <atomic>
#include <string>

#include <gale/base/error.hpp>
#include <gale/base/threads.hpp>
#include <gale/base/types.hpp>
#include <gale/mesh/intervals.hpp>
#include <gale/runtime/sweep_options.hpp>

namespace gale::detail {

/// Deals the segments of a sweep out to its consumers, ascending, a few at a time: whoever is done takes the next ones.
class SegmentCursor {
 public:
  SegmentCursor(const Interval& segments, int consumers)
      : end_(segments.last),
        at_once_(std::clamp(segments.size() / (64 * consumers), Id(1), Id(16))),
        next_(segments.first) {}

  struct Range {
    Id begin, end;
  };

  /// The next segments for one consumer; none, ever, when all are dealt out or someone called stop().
  Range take() {
    const Offset begin = stopped_ ? end_ : next_.fetch_add(at_once_);
    return {static_cast<Id>(std::min<Offset>(begin, end_)), static_cast<Id>(std::min<Offset>(begin + at_once_, end_))};
  }

  void stop() { stopped_ = true; }
  bool stopped() const { return stopped_; }

  /// Counts segments as done; returns how many are.
  Id finish(Id count) { return done_ += count; }

 private:
  const Id end_;
  const Id at_once_;
  std::atomic<Offset> next_;
  std::atomic<Id> done_{0};
  std::atomic<bool> stopped_{false};
};

/// Calls `options.progress` when a hundredth of the segments is done since it last did.
class ProgressReport {
 public:
  ProgressReport(Id segments, const SweepOptions& options) : segments_(segments), progress_(options.progress) {}

  void operator()(Id done) {
    if (!progress_ || done == told_ || (done < segments_ && done - told_ < segments_ / 100)) return;
    told_ = done;
    progress_(done, segments_);
  }

 private:
  const Id segments_;
  const std::function<void(Id, Id)>& progress_;
  Id told_ = 0;
};

/// The loop of every sweep: calls `body(consumer, segment)` once for each of the segments on `options.threads`
/// threads, each with a consumer's number of its own. Each consumer's segments ascend. Progress is told on the calling
/// thread, which is consumer 0, and at the end. The first exception that a body or the progress callback throws is
/// thrown again here, when the segments under way are done; no other is begun, nor when it is asked to stop. Throws
/// gale::Error for threads that nobody can have.
template <class Body>
void sweep(const Interval& segments, const SweepOptions& options, const Body& body) {
  require_thread_count(options.threads);
  SegmentCursor cursor(segments, options.threads);
  ProgressReport report(segments.size(), options);
  on_threads(options.threads, [&](int consumer) {
    try {
      for (auto range = cursor.take(); range.begin < range.end; range = cursor.take()) {
        for (Id segment = range.begin; segment < range.end; ++segment) {
          if (cursor.stopped()) return;
          stop_if_asked();
          body(consumer, segment);
        }
        const Id done = cursor.finish(range.end - range.begin);
        if (consumer == 0) report(done);
      }
    } catch (...) {
      cursor.stop();
      throw;
    }
  });
  report(segments.size());
}

/// Sweeps over segments from 0 on.
template <class Body>
void sweep(Id segments, const SweepOptions& options, const Body& body) {
  sweep(Interval{0, segments}, options, body);
}

}  // namespace gale::detail
