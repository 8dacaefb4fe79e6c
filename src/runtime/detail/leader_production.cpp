#include <algorithm>
#include <atomic>
#include <vector>

#include <gale/base/error.hpp>
#include <gale/relations/detail/sweep.hpp>
#include <gale/runtime/detail/defaults.hpp>
#include <gale/runtime/detail/implementation.hpp>
#include <gale/runtime/detail/leader.hpp>

namespace gale::detail {

namespace {

std::vector<RelationSet> queues_for(RelationSet relations, Queues queues) {
  if (queues == Queues::per_kernel) return {relations};
  const auto members = members_of(relations);
  return {members.begin(), members.end()};
}

std::unique_ptr<BatchProducer> make_producer(const Mesh& mesh, const ProducerParameters& parameters) {
  return have_device ? make_device_producer(mesh, parameters) : make_host_producer(mesh, parameters);
}

/// Fills in the blocks that a leader's lease has.
void add_blocks(SegmentRows& rows, const Leader& leader, const Lease& lease) {
  const auto members = leader.relations();
  for (int i = 0; i < relation_count; ++i) {
    const auto relation = static_cast<Relation>(i);
    if (members.has(relation)) rows.set(relation, lease.block(members.index_of(relation), members.count()));
  }
}

class LeaderProduction;

/// A consumer that has leaders produce.
class RequestingConsumer : public Consumer {
 public:
  RequestingConsumer(LeaderProduction& production, ConsumerLog& log) : production_(production), log_(log) {}
  ~RequestingConsumer() override { log_.add(statistics_); }

 protected:
  SegmentRows load(Relation relation, Id vertex) override;

 private:
  LeaderProduction& production_;
  ConsumerLog& log_;
  ConsumerStatistics statistics_;
  Lease leases_[relation_count];  ///< of the block read last in each relation
};

class LeaderProduction : public RuntimeImplementation {
 public:
  LeaderProduction(const Mesh& mesh, RelationSet relations, const RuntimeOptions& options)
      : RuntimeImplementation(mesh, relations) {
    const auto queues = queues_for(relations, options.queues);
    const Sizes sizes = sizes_for(mesh, options, static_cast<int>(queues.size()));
    for (const RelationSet members : queues) {
      std::vector<std::unique_ptr<BatchProducer>> producers;
      for (int i = 0; i < producers_per_leader; ++i) {
        producers.push_back(make_producer(mesh, {members, sizes.batch_words, sizes.threads_per_segment}));
      }
      leaders_.push_back(std::make_unique<Leader>(
          mesh, LeaderParameters{members, sizes.batch_words, sizes.host_bytes, sizes.segments_per_request}, std::move(producers)));
    }
  }

  void for_each_segment(RelationSet wanted, const SweepOptions& options, const Structure::SegmentBody& body) override {
    const SweepInProgress in_progress(*this, wanted);
    std::vector<ConsumerStatistics> statistics(std::max(options.threads, 0));
    sweep(mesh().segments(), options, [&](int consumer, Id segment) {
      visit(in_progress, segment, statistics[consumer], [&](const SegmentRows& rows) { body(consumer, rows); });
    });
    for (const auto& one : statistics) log_.add(one);
  }

  std::unique_ptr<Consumer> consumer() override { return std::make_unique<RequestingConsumer>(*this, log_); }

  Production production() const override { return Production::leaders; }

  RuntimeStatistics statistics() const override {
    RuntimeStatistics all;
    all.consumers = log_.all();
    for (const auto& leader : leaders_) {
      all.leaders.push_back(leader->statistics());
      all.host_bytes += leader->host_bytes();
      all.device_bytes += leader->device_bytes();
    }
    return all;
  }

  Leader& leader_of(Relation relation) {
    for (const auto& leader : leaders_) {
      if (leader->relations().has(relation)) return *leader;
    }
    require_preconditioned(relations(), relation);
    throw Error("no leader for " + name_of(relation));
  }

  SegmentRows rows_of(Id segment) const {
    const auto& begin = mesh().vertex_begin();
    return SegmentRows(segment, begin(segment), begin(segment + 1));
  }

 private:
  static constexpr int producers_per_leader = 3;

  /// Has the leaders run ahead as long as it lives; a sweep inside or beside another asks for each segment instead.
  class SweepInProgress {
   public:
    SweepInProgress(LeaderProduction& production, RelationSet wanted)
        : sweeping_(production.sweeping_), runs_ahead_(!production.sweeping_.exchange(true)) {
      for (const auto& leader : production.leaders_) {
        for (const Relation relation : members_of(wanted)) {
          if (!leader->relations().has(relation)) continue;
          leaders_.push_back(leader.get());
          break;
        }
      }
      if (!runs_ahead_) return;
      for (Leader* const leader : leaders_) leader->begin_sweep();
    }
    ~SweepInProgress() {
      if (!runs_ahead_) return;
      for (Leader* const leader : leaders_) leader->end_sweep();
      sweeping_ = false;
    }
    SweepInProgress(const SweepInProgress&) = delete;
    SweepInProgress& operator=(const SweepInProgress&) = delete;

    const std::vector<Leader*>& leaders() const { return leaders_; }
    bool runs_ahead() const { return runs_ahead_; }

   private:
    std::atomic<bool>& sweeping_;
    const bool runs_ahead_;
    std::vector<Leader*> leaders_;
  };

  template <class Body>
  void visit(const SweepInProgress& in_progress, Id segment, ConsumerStatistics& statistics, const Body& body) {
    const auto& leaders = in_progress.leaders();
    Lease leases[relation_count];
    SegmentRows rows = rows_of(segment);
    for (std::size_t i = 0; i < leaders.size(); ++i) {
      leases[i] = leaders[i]->acquire(segment, in_progress.runs_ahead(), statistics);
      add_blocks(rows, *leaders[i], leases[i]);
    }
    body(rows);
    for (std::size_t i = 0; i < leaders.size(); ++i) {
      if (leases[i].release_read()) leaders[i]->tell_read();
    }
  }

  std::atomic<bool> sweeping_{false};
  ConsumerLog log_;
  std::vector<std::unique_ptr<Leader>> leaders_;  ///< last, so that they end first
};

SegmentRows RequestingConsumer::load(Relation relation, Id vertex) {
  Leader& leader = production_.leader_of(relation);
  const Id segment = production_.mesh().segment_of(vertex);
  Lease& lease = leases_[static_cast<int>(relation)];
  lease.release();
  lease = leader.acquire(segment, false, statistics_);
  SegmentRows rows = production_.rows_of(segment);
  rows.set(relation, lease.block(leader.relations().index_of(relation), leader.relations().count()));
  return rows;
}

}  // namespace

std::unique_ptr<RuntimeImplementation> by_leaders(const Mesh& mesh, RelationSet relations, const RuntimeOptions& options) {
  return std::make_unique<LeaderProduction>(mesh, relations, options);
}

}  // namespace gale::detail
