#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <future>
#include <iterator>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#ifndef GALE_ENABLE_STD_THREADS
#include <omp.h>
#endif

#include <gale/base/error.hpp>
#include <gale/base/stop.hpp>
#include <gale/export.hpp>

namespace gale {

/// How many threads a host loop, or a sweep unless told otherwise, uses when this thread begins it: what was set, else
/// what OMP_NUM_THREADS says, else what OpenMP would take, but no more than the cores that the process may run on and
/// than a container's CPU quota, rounded up. No more than this thread's ThreadLimits, and most_threads, in any case.
GALE_EXPORT int host_threads();

/// The most threads that can be asked for: GCC's OpenMP ends the process where the system starts no more.
inline constexpr int most_threads = 1024;

/// From now on so many, 1 to most_threads (the nearest of these), whichever thread begins a loop. For the application,
/// before it begins: the library never calls it.
GALE_EXPORT void set_host_threads(int count);

/// While it lives, loops that this thread begins use at most so many threads, at least 1; of several that live, the
/// least counts. To be destroyed on the thread that made it, last made first.
class GALE_EXPORT ThreadLimit {
 public:
  /// At most so many, at least 1, until it is destroyed.
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  int before_;
};

namespace detail {

/// Throws gale::Error for a number of threads that nobody can have.
GALE_EXPORT void require_thread_count(int count);

/// How many threads OpenMP is asked for, to run so many bodies: as many as this thread has asked for before, within
/// host_threads(). GCC's ends the threads that a smaller team lacks, and starts others for the next large one, which
/// takes longer than many a loop.
GALE_EXPORT int team_for(int count);

}  // namespace detail

/// Calls `body(i)` for i in 0..count-1, each on a thread of its own as far as OpenMP grants them, and returns when all
/// have returned. The first exception that a body throws is thrown again here, after the others have ended. Loops that
/// a body begins run on its own thread. What asks this thread to stop asks the bodies.
template <class Body>
void on_threads(int count, const Body& body) {
  if (count <= 1) {
    body(0);
    return;
  }
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const StopRequest* const request = detail::stop_request();
  const auto guarded = [&](int i) {
    const ThreadLimit alone(1);
    const StopScope stoppable(request);
    try {
      body(i);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(failure_mutex);
      if (!failure) failure = std::current_exception();
    }
  };
#ifdef GALE_ENABLE_STD_THREADS
  std::vector<std::thread> others;
  int begun = 1;
  try {
    for (; begun < count; ++begun) others.emplace_back(guarded, begun);
  } catch (const std::exception&) {  // there are no more threads, or no memory for them: this one does the rest
  }
  guarded(0);
  for (int i = begun; i < count; ++i) guarded(i);
  for (auto& thread : others) thread.join();
#else
#pragma omp parallel num_threads(detail::team_for(count))
  for (int i = omp_get_thread_num(); i < count; i += omp_get_num_threads()) guarded(i);
#endif
  if (failure) std::rethrow_exception(failure);
}

/// Calls `body(thread, i)` for i in 0..n-1, each on one of `count` threads, which take what is next when they are done:
/// for work whose parts differ much. Exceptions as above; no further part is begun after one.
template <class Body>
void in_turns(int count, std::int64_t n, const Body& body) {
  std::atomic<std::int64_t> next{0};
  on_threads(count < n ? count : static_cast<int>(n), [&](int thread) {
    try {
      for (std::int64_t i = next++; i < n; i = next++) {
        detail::stop_if_asked();
        body(thread, i);
      }
    } catch (...) {
      next = n;
      throw;
    }
  });
}

namespace detail {

/// Calls each of these functions, on the host's threads, as `in_turns` does. Pass the longest first.
template <class... Work>
void side_by_side(const Work&... work) {
  const std::function<void()> all[] = {work...};
  in_turns(host_threads(), sizeof...(work), [&](int, std::int64_t i) { all[i](); });
}

/// Runs `beside` on a thread of its own, within what limits this one, while this one runs `here`; one after the other
/// where the host has one thread, or the system starts no more. When both have ended it throws what `here` threw, or
/// else what `beside` did.
template <class Beside, class Here>
void meanwhile(const Beside& beside, const Here& here) {
  const int threads = host_threads();
  const auto policy = threads > 1 ? std::launch::async | std::launch::deferred : std::launch::deferred;
  auto begun = std::async(policy, [&beside, threads, request = stop_request()] {
    const ThreadLimit limit(threads);
    const StopScope stoppable(request);
    beside();
  });
  here();
  begun.get();
}

/// Items that threads take in turns, while what they do with one adds others.
template <class Item>
class SharedItems {
 public:
  explicit SharedItems(std::vector<Item> items)
      : left_(std::make_move_iterator(items.begin()), std::make_move_iterator(items.end())) {}

  /// Adds one: a thread that waits for an item gets it at once.
  void operator()(Item item) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (has_failed_) return;
    left_.push_back(std::move(item));
    note_waiting();
    changed_.notify_one();
  }

  /// Whether threads wait, for more items than are left.
  bool are_short() const { return missing_.load(std::memory_order_relaxed) > 0; }

  /// Calls body(item) for each that this thread takes, until none is left and no thread may add one.
  template <class Body>
  void take_all(const Body& body) {
    std::unique_lock<std::mutex> lock(mutex_);
    for (;;) {
      ++waiting_;
      note_waiting();
      changed_.wait(lock, [&] { return !left_.empty() || busy_ == 0; });
      --waiting_;
      if (left_.empty()) return;
      const Item item = std::move(left_.front());
      left_.pop_front();
      note_waiting();
      ++busy_;
      lock.unlock();
      try {
        stop_if_asked();
        body(item);
      } catch (...) {
        lock.lock();
        has_failed_ = true;
        left_.clear();
        --busy_;
        changed_.notify_all();
        throw;
      }
      lock.lock();
      if (--busy_ == 0) changed_.notify_all();
    }
  }

 private:
  void note_waiting() { missing_.store(waiting_ - static_cast<int>(left_.size()), std::memory_order_relaxed); }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Item> left_;
  int waiting_ = 0, busy_ = 0;  ///< threads that wait for items, and that may still add some
  bool has_failed_ = false;
  std::atomic<int> missing_{0};
};

/// Calls `body(thread, item, more)` for each of some items, and for each that a body adds to these by more(item), on
/// `count` threads, in the order in which they were given. Exceptions as in `in_turns`: after one, what is added is
/// left.
template <class Item, class Body>
void in_turns_with_more(int count, std::vector<Item> items, const Body& body) {
  if (items.empty()) return;
  SharedItems<Item> all(std::move(items));
  on_threads(count, [&](int thread) { all.take_all([&](const Item& item) { body(thread, item, all); }); });
}

/// A new thread that runs `body`. Throws Error where the system starts no more.
template <class Body>
std::thread start_thread(Body&& body) {
  try {
    return std::thread(std::forward<Body>(body));
  } catch (const std::system_error& error) {
    throw Error(std::string("the system starts no more threads (") + error.code().message() +
                "): take fewer, or raise its limit of threads or of memory");
  }
}

/// How many CPUs a quota amounts to, rounded up, from the text of a control group's files; 0 where there is none, or
/// where the text isn't understood. Version 2 has one file, cpu.max: "150000 100000" is a quota and a period in
/// microseconds, "max 100000" none.
GALE_EXPORT int cpus_of_quota(const std::string& cpu_max);

/// Version 1 has two: cpu.cfs_quota_us, -1 for none, and cpu.cfs_period_us.
GALE_EXPORT int cpus_of_quota(const std::string& quota, const std::string& period);

/// The processors of the container that the process runs in; 0 where it has no quota.
GALE_EXPORT int cpu_quota();

/// The cores that the process may run on: those of its affinity, and no more than its quota. At least 1.
GALE_EXPORT int available_cores();

}  // namespace detail

}  // namespace gale
