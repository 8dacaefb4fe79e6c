#include "job.hpp"

#include <chrono>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <gale/base/device.hpp>
#include <gale/base/error.hpp>
#include <gale/base/kokkos.hpp>
#include <gale/base/threads.hpp>

#include "process.hpp"

namespace gale::python {

namespace {

/// A thread for one computation after the other, so that those that OpenMP begins for it stay. Waits for the last one
/// when it is destroyed.
class JobThread {
 public:
  JobThread() : thread_(gale::detail::start_thread([this] { work(); })) {}
  ~JobThread() {
    begin(nullptr);
    thread_.join();
  }
  JobThread(const JobThread&) = delete;
  JobThread& operator=(const JobThread&) = delete;

  /// To be called when the last one is done; null ends the thread.
  void begin(const std::function<void()>* compute) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      next_ = compute;
      has_next_ = true;
    }
    changed_.notify_one();
  }

 private:
  void work() {
    use_device();
    while (true) {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait(lock, [this] { return has_next_; });
      has_next_ = false;
      const std::function<void()>* const compute = next_;
      lock.unlock();
      if (compute == nullptr) return;
      (*compute)();
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  const std::function<void()>* next_ = nullptr;
  bool has_next_ = false;
  std::thread thread_;
};

/// All jobs, and the threads without one. Never destroyed: in a process that was forked the threads aren't there.
struct Shared {
  std::mutex mutex;
  bool are_stopped = false;
  std::set<Job*> jobs;
  std::vector<std::unique_ptr<JobThread>> idle;
};

Shared& shared() {
  static auto* const all = new Shared;
  return *all;
}

/// A job under way, and its thread. None begins once all are stopped: threads that would begin one then wait for the
/// end.
class UnderWay {
 public:
  explicit UnderWay(Job* job) : job_(job) {
    std::unique_lock<std::mutex> lock(shared().mutex);
    if (shared().are_stopped) {
      lock.unlock();
      end_call();  // which keeps this thread: what it would compute with may be gone
    }
    shared().idle.reserve(shared().jobs.size() + shared().idle.size() + 1);
    if (shared().idle.empty()) {
      thread = std::make_unique<JobThread>();
    } else {
      thread = std::move(shared().idle.back());
      shared().idle.pop_back();
    }
    shared().jobs.insert(job);
  }
  ~UnderWay() {
    const std::lock_guard<std::mutex> lock(shared().mutex);
    shared().jobs.erase(job_);
    shared().idle.push_back(std::move(thread));
  }
  UnderWay(const UnderWay&) = delete;
  UnderWay& operator=(const UnderWay&) = delete;

  std::unique_ptr<JobThread> thread;

 private:
  Job* const job_;
};

/// Whose turn it is on the device: jobs of several threads take it one after another. They share Kokkos' default
/// instance there, which is for one thread at a time, and the memory that is free. A job whose progress is told gives
/// its turn back meanwhile; what it goes on with then works on instances of its own.
class DeviceTurn {
 public:
  void take() {
    constexpr std::chrono::milliseconds between(1);
    std::unique_lock<std::mutex> lock(mutex_);
    while (is_taken_) {
      gale::detail::stop_if_asked();
      changed_.wait_for(lock, between);
    }
    is_taken_ = true;
  }
  void give_back() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      is_taken_ = false;
    }
    changed_.notify_one();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_taken_ = false;
};

DeviceTurn& device_turn() {
  static auto* const turn = new DeviceTurn;  // never destroyed, as what is shared
  return *turn;
}

/// As many threads as OpenMP would give the caller, whose choice is its thread's own.
int openmp_threads() {
#ifdef GALE_ENABLE_STD_THREADS
  return 0;
#else
  return omp_get_max_threads();
#endif
}
void set_openmp_threads([[maybe_unused]] int count) {
#ifndef GALE_ENABLE_STD_THREADS
  omp_set_num_threads(count);
#endif
}

}  // namespace

ComputeOptions Job::sweep_options(int threads) {
  if (threads < 0 || threads > most_threads)
    throw Error("threads is " + std::to_string(threads) + ", not 0 to " + std::to_string(most_threads));
  ComputeOptions options;
  if (threads > 0) options.threads = threads;
  if (!progress_.is_none()) options.progress = [this](Id done, Id all) { tell(done, all); };
  return options;
}

void Job::run_until_done(const std::function<void()>& compute) {
  begin_call();
  const nanobind::gil_scoped_release released;
  compute_on_worker(compute);
  end_call();
  if (raised_) std::rethrow_exception(raised_);
  if (failure_) std::rethrow_exception(failure_);
}

void Job::compute_on_worker(const std::function<void()>& compute) {
  const int threads = openmp_threads();
  const std::function<void()> guarded = [&] {
    set_openmp_threads(threads);
    std::exception_ptr failure;
    try {
      const StopScope stoppable(&request_);
      take_turn();
      compute();
    } catch (...) {
      failure = std::current_exception();
    }
    give_turn_back();
    const std::lock_guard<std::mutex> lock(mutex_);
    failure_ = std::move(failure);
    is_done_ = true;
    changed_.notify_all();
  };
  const UnderWay under_way(this);
  under_way.thread->begin(&guarded);
  std::unique_lock<std::mutex> lock(mutex_);
  while (!is_done_) watch(lock);
}

/// Waits until it is done, there is progress to tell, or it is time to look whether Python has something.
void Job::watch(std::unique_lock<std::mutex>& lock) {
  constexpr std::chrono::milliseconds between(50);
  changed_.wait_for(lock, between, [this] { return is_done_ || told_; });
  if (is_done_) return;
  const std::optional<Told> told = told_;
  if (!raised_) {
    lock.unlock();
    look_at_python(told);
    lock.lock();
  }
  if (!told) return;
  told_.reset();  // who tells waits for that
  changed_.notify_all();
}

void Job::look_at_python(const std::optional<Told>& told) {
  const nanobind::gil_scoped_acquire acquired;
  try {
    if (PyErr_CheckSignals() != 0) throw nanobind::python_error();
    if (told) progress_(told->done, told->all);
  } catch (const std::exception&) {
    raised_ = std::current_exception();
    stop();
  }
}

void Job::take_turn() {
  if constexpr (!have_device) return;
  device_turn().take();
  has_turn_ = true;
}

void Job::give_turn_back() {
  if (!has_turn_) return;
  has_turn_ = false;
  device_turn().give_back();
}

/// Has the caller's thread call `progress`, which may compute something else, and waits for that.
void Job::tell(Id done, Id all) {
  give_turn_back();
  std::unique_lock<std::mutex> lock(mutex_);
  told_ = Told{done, all};
  changed_.notify_all();
  changed_.wait(lock, [this] { return !told_; });
  lock.unlock();
  gale::detail::stop_if_asked();
  take_turn();
}

bool stop_jobs(std::chrono::milliseconds time) {
  const auto are_stopped = [] {
    const std::lock_guard<std::mutex> lock(shared().mutex);
    shared().are_stopped = true;
    for (Job* const job : shared().jobs) job->stop();
    return shared().jobs.empty();
  };
  constexpr std::chrono::milliseconds between(1);
  while (!are_stopped() && time.count() > 0) {
    std::this_thread::sleep_for(between);
    time -= between;
  }
  return are_stopped();
}

void end_workers() {
  const std::lock_guard<std::mutex> lock(shared().mutex);
  shared().idle.clear();
}

}  // namespace gale::python
