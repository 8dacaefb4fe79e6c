#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <gale/base/error.hpp>
#include <gale/runtime/leaders/block_store.hpp>
#include <gale/runtime/statistics.hpp>

namespace gale::detail {

using Clock = std::chrono::steady_clock;

inline double seconds_between(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

/// What a consumer waits with for the blocks of one segment.
class Ticket {
 public:
  // When the request was begun, taken, and its batch launched and finished: set by whoever did it.
  Clock::time_point begun, taken, launched, finished;

  void fulfil(Lease lease) {
    const std::lock_guard<std::mutex> lock(mutex_);
    lease_ = std::move(lease);
    done_ = true;
    changed_.notify_one();
  }

  void fail(const std::string& why) {
    const std::lock_guard<std::mutex> lock(mutex_);
    failure_ = why;
    done_ = true;
    changed_.notify_one();
  }

  /// The blocks, when they are there. Throws gale::Error that says why they never will be.
  Lease wait() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return done_; });
    if (!lease_) throw Error(failure_);
    return std::move(lease_);
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool done_ = false;
  Lease lease_;
  std::string failure_;
};

struct Request {
  Id segment;
  bool in_sweep;  ///< asked for by the running sweep, whose order the leader knows
  std::shared_ptr<Ticket> ticket;
};

/// The FIFO queue between consumers and one leader. Thread-safe.
class RequestQueue {
 public:
  /// What happened since the leader looked last.
  struct News {
    std::vector<Request> requests;
    bool stop = false;
    bool sweep_began = false;
    bool sweep_ended = false;
  };

  /// False if the queue is stopped: then the request is not on it.
  bool push(const Request& request) {
    return change([&] { news_.requests.push_back(request); });
  }
  void begin_sweep() {
    change([&] { news_.sweep_began = true; });
  }
  /// The leader has news: some arena may be free now.
  void wake() {
    change([] {});
  }
  void end_sweep() {
    std::unique_lock<std::mutex> lock(mutex_);
    news_.sweep_ended = awake_ = true;
    changed_.notify_one();
    // So that the next sweep doesn't begin before this one has ended.
    sweep_over_.wait(lock, [this] { return !news_.sweep_ended || news_.stop; });
  }
  void stop() {
    change([&] { news_.stop = true; });
    sweep_over_.notify_all();
  }

  /// Everything new; if `wait`, not before there is something.
  News take(bool wait) {
    std::unique_lock<std::mutex> lock(mutex_);
    if (wait) changed_.wait(lock, [this] { return awake_; });
    News taken = std::move(news_);
    news_ = News();
    news_.stop = taken.stop;
    awake_ = false;
    if (taken.sweep_ended) sweep_over_.notify_all();
    return taken;
  }

 private:
  template <class Change>
  bool change(const Change& apply) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (news_.stop) return false;
    apply();
    awake_ = true;
    changed_.notify_one();
    return true;
  }

  std::mutex mutex_;
  std::condition_variable changed_, sweep_over_;
  News news_;
  bool awake_ = false;
};

}  // namespace gale::detail
