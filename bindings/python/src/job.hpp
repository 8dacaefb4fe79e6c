#pragma once

#include <nanobind/nanobind.h>

#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <future>
#include <mutex>
#include <optional>
#include <utility>

#include <gale/base/device.hpp>
#include <gale/base/stop.hpp>
#include <gale/base/threads.hpp>
#include <gale/runtime/computation.hpp>

// How GALE computes for Python: on a thread of its own, while the caller's waits and looks every 50 ms whether Python
// has an interrupt for it. So Ctrl-C comes when the computation asks whether to stop, in whichever of its loops it is.

namespace gale::python {

/// One computation. To be made with Python's lock.
class Job {
 public:
  /// `progress` is None, or called on the caller's thread with how much is done, of how much.
  explicit Job(nanobind::handle progress = nanobind::none()) : progress_(progress) {}

  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  /// How this job computes: on so many threads, or as many as there are cores for 0.
  ComputeOptions sweep_options(int threads);

  /// What `compute()` returns, which is called without Python's lock. Throws what it throws; or what an interrupt or
  /// `progress` raises, when it has ended.
  template <class Compute>
  auto run(const Compute& compute) {
    std::optional<decltype(compute())> result;
    run_until_done([&] { result.emplace(compute()); });
    return *std::move(result);
  }

  /// From any thread.
  void stop() { request_.stop(); }

 private:
  struct Told {
    Id done, all;
  };

  void run_until_done(const std::function<void()>& compute);
  void compute_on_worker(const std::function<void()>& compute);
  void watch(std::unique_lock<std::mutex>& lock);
  void look_at_python(const std::optional<Told>& told);
  void tell(Id done, Id all);
  void take_turn();
  void give_turn_back();

  const nanobind::handle progress_;  ///< the caller holds it
  StopRequest request_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_done_ = false;
  bool has_turn_ = false;       ///< on the device; by the computation alone, which tells one step after the other
  std::optional<Told> told_;    ///< what `progress` hasn't heard yet
  std::exception_ptr failure_;  ///< of the computation
  std::exception_ptr raised_;   ///< by Python
};

/// What `compute()` will return, which is called meanwhile on a thread of its own, where the system starts one. It is
/// stopped when this thread is, and its loops take as many threads as this one's. Before a job ends it is to be waited
/// for.
template <class Compute>
auto in_background(Compute compute) {
  return std::async([compute = std::move(compute), request = gale::detail::stop_request(), threads = host_threads()] {
    const StopScope stoppable(request);
    const ThreadLimit limit(threads);
    use_device();
    return compute();
  });
}

/// Stops all that are under way, and waits for that; false if one doesn't end in time. No other begins.
bool stop_jobs(std::chrono::milliseconds time);

/// Ends the threads that jobs have run on.
void end_workers();

}  // namespace gale::python
