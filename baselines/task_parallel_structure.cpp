#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include <gale/base/threads.hpp>
#include <gale/baselines/task_parallel_structure.hpp>
#include <gale/runtime/batches/host_worker.hpp>
#include <gale/runtime/defaults.hpp>
#include <gale/runtime/statistics.hpp>
#include <gale/runtime/ways.hpp>

namespace gale::baselines {

namespace {

/// Between a consumer and its worker: some segments' blocks, computed in turn and read in turn. Who has to wait looks
/// for a while before it sleeps, since a segment takes no longer than falling asleep and being woken.
class Pipe {
 public:
  /// `stopped` is set when some consumer of the sweep fails, and tells the others to read no more.
  Pipe(const Mesh& mesh, RelationSet relations, std::atomic<bool>& stopped)
      : stopped_(stopped), worker_(mesh, relations, slots) {}

  /// Computes a segment when there is room for its blocks. By the worker. Throws what the consumer failed with, once it
  /// has.
  void fill(Id segment) {
    const std::size_t filled = filled_.load();
    wait_until([&] { return filled - read_.load() < slots || failed_.load() || stopped_.load(); });
    if (failed_.load()) std::rethrow_exception(failure_);
    if (stopped_.load()) return;
    rows_[filled % slots] = worker_.compute(segment);
    change([&] { filled_.store(filled + 1); });
  }

  /// There won't be more. By the worker.
  void end() {
    change([this] { ended_.store(true); });
  }

  /// Calls body(rows) for all segments, until the end. By the consumer.
  template <class Body>
  void consume(const Body& body, ConsumerStatistics& statistics) {
    try {
      for (std::size_t read = 0; wait_for(read, statistics) && !stopped_; ++read) {
        body(rows_[read % slots]);
        change([&] { read_.store(read + 1); });
      }
      change([] {});  // the worker may sleep, and nobody reads any more
    } catch (...) {
      failure_ = std::current_exception();
      stopped_ = true;
      change([this] { failed_.store(true); });
    }
  }

  /// After the consumer has ended: throws what it failed with.
  void rethrow() const {
    if (failed_.load()) std::rethrow_exception(failure_);
  }

 private:
  static constexpr std::size_t slots = 8;

  /// Waits for the next segment; false if there is none.
  bool wait_for(std::size_t next, ConsumerStatistics& statistics) {
    if (filled_.load() > next) {
      ++statistics.hits;
      return true;
    }
    const auto begin = std::chrono::steady_clock::now();
    wait_until([&] { return filled_.load() > next || ended_.load(); });
    if (filled_.load() <= next) return false;
    ++statistics.requests;
    statistics.waiting.kernel_and_transfer +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return true;
  }

  template <class Condition>
  void wait_until(const Condition& condition) {
    constexpr int patience = 4000;
    for (int look = 0; look < patience; ++look) {
      if (condition()) return;
    }
    std::unique_lock<std::mutex> lock(mutex_);
    ++sleepers_;
    changed_.wait(lock, condition);
    --sleepers_;
  }

  /// A sleeper counts itself before it looks for the last time, and here something changes before sleepers are counted:
  /// so nobody sleeps on.
  template <class Change>
  void change(const Change& apply) {
    apply();
    if (sleepers_.load() == 0) return;
    { const std::lock_guard<std::mutex> lock(mutex_); }
    changed_.notify_all();
  }

  std::atomic<bool>& stopped_;
  HostWorker worker_;
  std::array<SegmentRows, slots> rows_;
  alignas(64) std::atomic<std::size_t> filled_{0};
  alignas(64) std::atomic<std::size_t> read_{0};
  std::atomic<bool> ended_{false}, failed_{false};
  std::exception_ptr failure_;
  std::atomic<int> sleepers_{0};
  std::mutex mutex_;
  std::condition_variable changed_;
};

/// A structure whose sweeps give each consumer a worker thread, which runs ahead of it.
class TaskParallelStructure : public detail::InlineStructure {
 public:
  using InlineStructure::InlineStructure;

  std::string name() const override { return "task-parallel"; }

 protected:
  std::unique_ptr<Sweep> begin_sweep(RelationSet wanted, int consumers, const SegmentBody& body) override;
};

std::unique_ptr<Structure::Sweep> TaskParallelStructure::begin_sweep(RelationSet wanted, int consumers,
                                                                     const SegmentBody& body) {
  /// The sweep's threads compute; the consumers are threads that each read a pipe.
  class PipedSweep : public Sweep {
   public:
    PipedSweep(const Mesh& mesh, RelationSet wanted, int consumers, const SegmentBody& body) : Sweep(consumers) {
      for (int i = 0; i < consumers; ++i) pipes_.push_back(std::make_unique<Pipe>(mesh, wanted, stopped_));
      try {
        for (int i = 0; i < consumers; ++i) {
          threads_.push_back(detail::start_thread([this, i, &body] {
            pipes_[i]->consume([&](const SegmentRows& rows) { body(i, rows); }, statistics[i]);
          }));
        }
      } catch (...) {  // there are no more threads to be had
        join();
        throw;
      }
    }
    ~PipedSweep() override { join(); }

    void visit(int worker, Id segment, const SegmentBody&) override { pipes_[worker]->fill(segment); }

    void end() override {
      join();
      for (const auto& pipe : pipes_) pipe->rethrow();
    }

   private:
    /// Waits until everything is read.
    void join() {
      for (auto& pipe : pipes_) pipe->end();
      for (auto& thread : threads_) thread.join();
      threads_.clear();
    }

    std::atomic<bool> stopped_{false};
    std::vector<std::unique_ptr<Pipe>> pipes_;
    std::vector<std::thread> threads_;
  };
  return std::make_unique<PipedSweep>(mesh(), wanted, consumers, body);
}

}  // namespace

std::unique_ptr<Structure> make_task_parallel_structure(const Mesh& mesh, RelationSet relations) {
  detail::require_relations(relations);
  require_relations(relations, mesh.dimension());
  return std::make_unique<TaskParallelStructure>(mesh, relations);
}

}  // namespace gale::baselines
