#include <algorithm>
#include <atomic>
#include <vector>

#include <gale/relations/face_reader.hpp>
#include <gale/relations/host_worker.hpp>
#include <gale/relations/kernels/segment_kernel.hpp>
#include <gale/runtime/implementation.hpp>
#include <gale/runtime/leaders/defaults.hpp>
#include <gale/runtime/leaders/sweep_reader.hpp>
#include <gale/runtime/sweep.hpp>

namespace gale::detail {

namespace {

std::vector<RelationSet> queues_for(RelationSet relations, Queues queues) {
  if (queues == Queues::per_kernel) return kernels_for(relations);
  const auto members = members_of(relations);
  return {members.begin(), members.end()};
}

std::unique_ptr<BatchWorker> make_worker(const Mesh& mesh, const WorkerParameters& parameters) {
  return have_device ? make_device_worker(mesh, parameters) : make_host_worker(mesh, parameters);
}

/// The leaders of a runtime, and what their consumers leave behind. Consumers share it, so that one that the runtime's
/// end surprises finds everything in place.
class Leaders {
 public:
  Leaders(const Mesh& mesh, RelationSet relations, const RuntimeOptions& options) : mesh(mesh), relations(relations) {
    mesh.simplices(needs_of(relations & face_relations));
    const auto queues = queues_for(relations - face_relations, options.queues);
    const Sizes sizes = sizes_for(mesh, options, std::max(static_cast<int>(queues.size()), 1));
    for (const RelationSet members : queues) {
      std::vector<std::unique_ptr<BatchWorker>> workers;
      WorkerParameters parameters{members, sizes.batch_words, sizes.threads_per_segment, nullptr};
      if (have_device)
        parameters.bounds =
            find_segment_bounds(mesh, SegmentKernel<WorkerMemory>(mesh, members), parameters.threads_per_segment);
      for (int i = 0; i < workers_per_leader; ++i) workers.push_back(make_worker(mesh, parameters));
      leaders.push_back(std::make_unique<Leader>(
          mesh, LeaderParameters{members, sizes.batch_words, sizes.host_bytes, sizes.segments_per_request},
          std::move(workers)));
    }
  }

  Leader& of(Relation relation) const {
    const auto has = [&](const auto& leader) { return leader->relations().has(relation); };
    return **std::find_if(leaders.begin(), leaders.end(), has);
  }

  SegmentRows rows_of(Id segment) const { return SegmentRows(segment, mesh.intervals_of(segment)); }

  const Mesh mesh;
  const RelationSet relations;
  std::vector<std::unique_ptr<Leader>> leaders;
  ConsumerLog log;

 private:
  /// One computes, another's blocks are copied, and those of the third are published.
  static constexpr int workers_per_leader = 3;
};

/// Fills in the blocks that a leader's lease has.
void add_blocks(SegmentRows& rows, const Leader& leader, const Lease& lease) {
  const RelationSet relations = leader.relations();
  for (const Relation relation : members_of(relations))
    rows.set(relation, lease.block(relations.index_of(relation), relations.count()));
}

/// A consumer that has leaders compute.
class RequestingConsumer : public Consumer {
 public:
  explicit RequestingConsumer(std::shared_ptr<Leaders> leaders)
      : leaders_(std::move(leaders)), faces_(leaders_->mesh, leaders_->relations & face_relations) {}
  ~RequestingConsumer() override { leaders_->log.add(statistics_); }

 protected:
  SegmentRows load(Relation relation, Id simplex) override {
    require_preconditioned(leaders_->relations, relation);
    require_simplex(leaders_->mesh, row_dimension(relation), simplex);
    if (face_relations.has(relation)) return faces_.row(relation, simplex);
    Leader& leader = leaders_->of(relation);
    const Id segment = leaders_->mesh.segment_of(row_dimension(relation), simplex);
    Lease& lease = leases_[static_cast<int>(relation)];
    lease.release();
    lease = leader.acquire(segment, false, statistics_);
    SegmentRows rows = leaders_->rows_of(segment);
    rows.set(relation, lease.block(leader.relations().index_of(relation), leader.relations().count()));
    return rows;
  }

 private:
  std::shared_ptr<Leaders> leaders_;
  FaceReader faces_;
  ConsumerStatistics statistics_;
  Lease leases_[relation_count];  ///< of the block read last in each relation
};

class LeaderProduction : public RuntimeImplementation {
 public:
  LeaderProduction(const Mesh& mesh, RelationSet relations, const RuntimeOptions& options)
      : RuntimeImplementation(mesh, relations), leaders_(std::make_shared<Leaders>(mesh, relations, options)) {}
  ~LeaderProduction() override {
    for (const auto& leader : leaders_->leaders) leader->end();
  }

  void for_each_segment(RelationSet wanted, const SweepOptions& options, const Structure::SegmentBody& body) override {
    const SweepInProgress in_progress(*this, wanted);
    const RelationSet faces = wanted & face_relations;
    std::vector<SweepConsumer> consumers(std::max(options.threads, 0));
    sweep(mesh().segments(), options, [&](int number, Id segment) {
      SweepConsumer& consumer = consumers[number];
      if (!consumer.ready) {
        for (Leader* const leader : in_progress.leaders())
          consumer.readers.emplace_back(*leader, in_progress.runs_ahead());
        if (!faces.empty()) consumer.look_up = std::make_unique<HostWorker>(mesh(), faces);
        consumer.ready = true;
      }
      SegmentRows rows = leaders_->rows_of(segment);
      for (auto& reader : consumer.readers)
        add_blocks(rows, reader.leader(), reader.read(segment, consumer.statistics));
      if (consumer.look_up) consumer.look_up->compute(rows);
      body(number, rows);
      for (auto& reader : consumer.readers) reader.done();
    });
    for (const auto& one : consumers) leaders_->log.add(one.statistics);
  }

  std::unique_ptr<Consumer> consumer() override { return std::make_unique<RequestingConsumer>(leaders_); }

  Way way() const override { return Way::leaders; }

  RuntimeStatistics statistics() const override {
    RuntimeStatistics all;
    all.consumers = leaders_->log.all();
    for (const auto& leader : leaders_->leaders) {
      all.leaders.push_back(leader->statistics());
      all.host_bytes += leader->host_bytes();
      all.device_bytes += leader->device_bytes();
    }
    return all;
  }

 private:
  /// Has the leaders run ahead as long as it lives; a sweep inside or beside another asks for each segment instead.
  class SweepInProgress {
   public:
    SweepInProgress(LeaderProduction& structure, RelationSet wanted)
        : sweeping_(structure.sweeping_), runs_ahead_(!structure.sweeping_.exchange(true)) {
      for (const auto& leader : structure.leaders_->leaders) {
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

  /// What one consumer of a sweep works with.
  struct alignas(64) SweepConsumer {
    bool ready = false;
    ConsumerStatistics statistics;
    std::vector<SweepReader> readers;     ///< one for each leader
    std::unique_ptr<HostWorker> look_up;  ///< if face relations are wanted
  };

  std::atomic<bool> sweeping_{false};
  std::shared_ptr<Leaders> leaders_;
};

}  // namespace

std::unique_ptr<RuntimeImplementation> by_leaders(const Mesh& mesh, RelationSet relations,
                                                  const RuntimeOptions& options) {
  return std::make_unique<LeaderProduction>(mesh, relations, options);
}

}  // namespace gale::detail
