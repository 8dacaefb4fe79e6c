#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <mutex>

#include <gale/export.hpp>

namespace gale {

/// What a computation throws that was asked to stop. No std::exception, so that nobody takes it for a failure.
struct GALE_EXPORT Stopped {};

/// Asks computations to stop, from any thread or a signal handler.
class StopRequest {
 public:
  /// Makes the request. It can't be taken back.
  void stop() { is_made_.store(true, std::memory_order_relaxed); }

  /// Whether it was made.
  bool is_made() const { return is_made_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> is_made_{false};
};

/// While it lives, what this thread computes, also on threads that it begins for that, throws Stopped soon after the
/// request is made; with nullptr nothing stops it. What was under way is given up, and what was there before can be
/// used as before. To be destroyed on the thread that made it, last made first.
///
/// A rank of several stops where they tell each other what has failed: it throws Stopped, the others gale::SharedError.
class GALE_EXPORT StopScope {
 public:
  /// Begins with `request`, which must outlive this.
  explicit StopScope(const StopRequest* request);

  /// Ends: what was asked before this holds again.
  ~StopScope();
  StopScope(const StopScope&) = delete;
  StopScope& operator=(const StopScope&) = delete;

 private:
  const StopRequest* before_;
  bool could_stop_;
};

namespace detail {

/// Has this thread not stop, as other ranks wait for what it does next, until its StopScope ends; but where they hear
/// of it, while a StopsHere lives.
GALE_EXPORT void await_ranks();

/// While it lives, what asks this thread to stop does so: others will hear of it. Ends as await_ranks() if that was
/// called before.
class GALE_EXPORT StopsHere {
 public:
  StopsHere();
  ~StopsHere();
  StopsHere(const StopsHere&) = delete;
  StopsHere& operator=(const StopsHere&) = delete;

 private:
  const bool could_stop_;
};

/// What this thread's computations look at; nullptr if nothing stops them.
GALE_EXPORT const StopRequest* stop_request();

/// Throws Stopped if this thread's computations were asked to stop. A few ns: every loop that may take long, on the
/// host, calls it now and then.
GALE_EXPORT void stop_if_asked();

/// Throws Stopped likewise in the i-th step of a loop of short ones: looks in some of them.
inline void stop_if_asked_at(std::int64_t i) {
  constexpr std::int64_t between = 1 << 12;
  if (i % between == 0) stop_if_asked();
}

/// Locks a mutex that others may hold while they compute for long.
GALE_EXPORT std::unique_lock<std::mutex> lock_or_stop(std::mutex& mutex);

}  // namespace detail

}  // namespace gale
