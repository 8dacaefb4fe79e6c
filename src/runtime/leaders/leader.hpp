#pragma once

#include <deque>
#include <functional>
#include <map>
#include <string>
#include <thread>

#include <gale/mesh/mesh.hpp>
#include <gale/runtime/leaders/batch_worker.hpp>
#include <gale/runtime/leaders/request_queue.hpp>

namespace gale::detail {

/// What a leader works with.
struct LeaderParameters {
  RelationSet relations;
  Offset arena_words = 0;
  std::size_t host_budget = 0;
  Id segments_per_request = 1;

  /// Makes who computes a segment that the device has no memory for; without it that is a failure.
  std::function<std::unique_ptr<BatchWorker>()> make_host_worker;
};

/// The leader worker of one queue: a thread that takes requests, forms batches, has them computed, and publishes their
/// blocks.
class Leader {
 public:
  /// `workers`: at least one; with three, one computes, another's blocks are copied, and those of the third are
  /// published.
  Leader(const Mesh& mesh, const LeaderParameters& parameters, std::vector<std::unique_ptr<BatchWorker>> workers);

  ~Leader();

  /// Fails all requests that wait, and those that come, and returns when their consumers have gone.
  void end();

  RelationSet relations() const { return parameters_.relations; }

  /// The blocks of a segment, as soon as they are there. By any thread. Throws gale::Error.
  Lease acquire(Id segment, bool in_sweep, ConsumerStatistics& statistics);

  /// Adds what a lease has.
  void add_rows(const Lease& lease, SegmentRows& rows) const {
    gale::add_rows(lease.arena().batch(parameters_.relations, intervals_), lease.slot(), rows);
  }

  /// Moves a lease to another segment of its arena; false if it has no blocks of that. By any thread.
  bool move(Lease& lease, Id segment) const { return store_.move(lease, segment); }

  /// From now on, runs ahead through all segments; until end_sweep. One sweep at a time.
  void begin_sweep() { queue_.begin_sweep(); }
  void end_sweep() { queue_.end_sweep(); }

  /// An arena may be free: the sweep has read all of it.
  void tell_read() { queue_.wake(); }

  LeaderStatistics statistics() const;
  std::size_t host_bytes() const { return store_.peak_bytes(); }
  std::size_t device_bytes() const;

  /// Does the exception that is being handled say that memory ran out? Ours does, or the standard library's.
  static bool is_out_of_memory();

 private:
  /// Segments in a list, to be computed together. Where one of them is known to need more words, it says so.
  struct Plan : BatchPlan {
    bool ahead = false;  ///< computed for the running sweep, which will read them
    bool alone = false;  ///< not to be joined with others: it is part of one that didn't fit
  };
  struct Flight {
    Plan plan;
    BatchWorker* worker;
    std::shared_ptr<BatchWorker> on_host;  ///< the worker, if it isn't one of the leader's own
    Arena* arena;
    Clock::time_point launched;
    bool copying = false;
  };

  void prepare_arenas();
  std::string end_message() const;
  void run();
  void listen(bool wait);
  void serve(const Request& request, Clock::time_point taken);
  void plan_from(Id segment);
  bool launch_next();
  Plan next_requests();
  bool launch_ahead();
  Plan plan_ahead();
  void launch(Plan plan, Arena& arena);
  bool launch_on_host(const Plan& plan, const BatchPlan& in_arena, Arena& arena);
  void release(const Flight& flight);
  void plan_again(const Plan& plan, const BatchShortfall& lacked);
  void begin_copy(Flight& flight);
  void finish_oldest();
  void account(const std::vector<Id>& made, const BatchShortfall& lacked, std::size_t launched);
  void deliver(const std::vector<Id>& segments, Clock::time_point launched, Clock::time_point finished);
  void fail_all(const std::string& why);
  Id segments_that_fit() const;
  Offset words_for(std::size_t segments) const;
  bool is_wanted(Id segment) const { return !under_way_[segment] && !store_.is_resident(segment); }

  const Mesh mesh_;
  const LeaderParameters parameters_;
  const std::vector<std::unique_ptr<BatchWorker>> workers_;
  RequestQueue queue_;
  BlockStore store_;
  const IntervalTables<HostMemory> intervals_;

  // The leader thread's own.
  std::multimap<Id, std::shared_ptr<Ticket>> waiting_;  ///< by segment
  std::deque<Plan> plans_;
  std::deque<Flight> flights_;
  std::vector<BatchWorker*> idle_;
  std::vector<bool> under_way_;  ///< by segment: planned or launched
  std::vector<bool> computed_;   ///< by segment: at some time
  bool prepared_ = false;
  bool sweeping_ = false;
  bool stopping_ = false;
  Id ahead_ = 0;       ///< the next segment that run-ahead computes
  Id must_reach_ = 0;  ///< run-ahead has to get here whatever the budget: a consumer waits
  Id ahead_batch_ = 0;
  double words_per_segment_ = 0;

  mutable std::mutex statistics_mutex_;
  LeaderStatistics statistics_;
  std::atomic<int> consumers_inside_{0};
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace gale::detail
