#include <algorithm>
#include <array>
#include <condition_variable>
#include <thread>

#include <gale/relations/detail/sweep.hpp>
#include <gale/relations/host_producer.hpp>
#include <gale/runtime/detail/implementation.hpp>

namespace gale::detail {

namespace {

using Clock = std::chrono::steady_clock;

/// Between a consumer and its producer: some segments' blocks, computed in turn and read in turn.
class Pipe {
 public:
  Pipe(const Mesh& mesh, RelationSet relations) {
    for (auto& producer : producers_) producer = std::make_unique<HostProducer>(mesh, relations);
  }

  /// Computes a segment when there is room for its blocks. By the producer. Throws what the consumer failed with, once it has.
  void produce(Id segment) {
    const std::size_t slot = filled_ % slots;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait(lock, [this] { return filled_ - read_ < slots || failure_; });
      if (failure_) std::rethrow_exception(failure_);
    }
    rows_[slot] = producers_[slot]->compute(segment);
    change([this] { ++filled_; });
  }

  /// There won't be more. By the producer.
  void end() {
    change([this] { ended_ = true; });
  }

  /// Calls body(rows) for all segments, until the end. By the consumer.
  template <class Body>
  void consume(const Body& body, ConsumerStatistics& statistics) {
    try {
      while (wait_for_next(statistics)) {
        body(rows_[read_ % slots]);
        change([this] { ++read_; });
      }
    } catch (...) {
      change([this] { failure_ = std::current_exception(); });
    }
  }

  /// After the consumer has ended: throws what it failed with.
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  static constexpr std::size_t slots = 8;

  /// False if there is none.
  bool wait_for_next(ConsumerStatistics& statistics) {
    std::unique_lock<std::mutex> lock(mutex_);
    if (filled_ > read_) {
      ++statistics.hits;
      return true;
    }
    const auto begin = Clock::now();
    changed_.wait(lock, [this] { return filled_ > read_ || ended_; });
    if (filled_ == read_) return false;
    ++statistics.requests;
    statistics.waiting.production += std::chrono::duration<double>(Clock::now() - begin).count();
    return true;
  }

  template <class Change>
  void change(const Change& apply) {
    const std::lock_guard<std::mutex> lock(mutex_);
    apply();
    changed_.notify_all();
  }

  std::array<std::unique_ptr<HostProducer>, slots> producers_;
  std::array<SegmentRows, slots> rows_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t filled_ = 0, read_ = 0;
  bool ended_ = false;
  std::exception_ptr failure_;
};

/// The consumers of a sweep, each a thread that reads its pipe.
class PipeReaders {
 public:
  PipeReaders(const Mesh& mesh, RelationSet wanted, int count, const Structure::SegmentBody& body) : statistics_(count) {
    for (int i = 0; i < count; ++i) pipes_.push_back(std::make_unique<Pipe>(mesh, wanted));
    for (int i = 0; i < count; ++i) {
      threads_.emplace_back([this, i, &body] { pipes_[i]->consume([&](const SegmentRows& rows) { body(i, rows); }, statistics_[i]); });
    }
  }
  ~PipeReaders() { end(); }

  Pipe& operator[](int consumer) { return *pipes_[consumer]; }

  /// Waits until everything is read.
  void end() {
    for (auto& pipe : pipes_) pipe->end();
    for (auto& thread : threads_) thread.join();
    threads_.clear();
  }

  void rethrow() const {
    for (const auto& pipe : pipes_) pipe->rethrow();
  }

  const std::vector<ConsumerStatistics>& statistics() const { return statistics_; }

 private:
  std::vector<std::unique_ptr<Pipe>> pipes_;
  std::vector<ConsumerStatistics> statistics_;
  std::vector<std::thread> threads_;
};

/// In a sweep each consumer has a producer, which runs ahead of it; consumers that ask in any order produce for themselves.
class PairProduction : public RuntimeImplementation {
 public:
  PairProduction(const Mesh& mesh, RelationSet relations, Pairs pairs)
      : RuntimeImplementation(mesh, relations), pairs_(pairs), alone_(by_consumers(mesh, relations)) {}

  void for_each_segment(RelationSet wanted, const SweepOptions& options, const Structure::SegmentBody& body) override {
    if (pairs_ == Pairs::on_idle_cores && 2 * options.threads > host_threads()) {
      alone_->for_each_segment(wanted, options, body);
      return;
    }
    PipeReaders readers(mesh(), wanted, std::max(options.threads, 0), body);
    sweep(mesh().segments(), options, [&](int producer, Id segment) { readers[producer].produce(segment); });
    readers.end();
    for (const auto& one : readers.statistics()) log_.add(one);
    readers.rethrow();
  }

  std::unique_ptr<Consumer> consumer() override { return alone_->consumer(); }
  Production production() const override { return pairs_ == Pairs::always ? Production::pairs : Production::consumers; }

  RuntimeStatistics statistics() const override {
    RuntimeStatistics all = alone_->statistics();
    const auto swept = log_.all();
    all.consumers.insert(all.consumers.end(), swept.begin(), swept.end());
    return all;
  }

 private:
  Pairs pairs_;
  std::unique_ptr<RuntimeImplementation> alone_;
  ConsumerLog log_;
};

}  // namespace

std::unique_ptr<RuntimeImplementation> by_pairs(const Mesh& mesh, RelationSet relations, Pairs pairs) {
  return std::make_unique<PairProduction>(mesh, relations, pairs);
}

}  // namespace gale::detail
