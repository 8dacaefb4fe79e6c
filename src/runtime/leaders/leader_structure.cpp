#include <algorithm>
#include <atomic>
#include <memory>
#include <utility>
#include <vector>

#include <gale/relations/kernels/segment_kernel.hpp>
#include <gale/relations/preconditioning.hpp>
#include <gale/runtime/batches/host_worker.hpp>
#include <gale/runtime/defaults.hpp>
#include <gale/runtime/leaders/leader.hpp>
#include <gale/runtime/segment_consumer.hpp>
#include <gale/runtime/ways.hpp>

namespace gale::detail {

namespace {

/// One computes, another's blocks are copied, and those of the third are published.
constexpr int workers_per_leader = 3;

std::vector<RelationSet> queues_for(RelationSet relations, int dimension, Queues queues) {
  if (queues == Queues::per_kernel) return kernels_for(relations, dimension);
  const auto members = members_of(relations);
  std::vector<RelationSet> each(members.begin(), members.end());
  if (relations.has_links()) each.push_back(link_form);
  return each;
}

std::unique_ptr<Leader> make_leader(const Mesh& mesh, RelationSet relations, const Sizes& sizes) {
  const WorkerParameters worker{relations, sizes.batch_words, sizes.threads_per_segment};
  LeaderParameters leader{relations, sizes.batch_words, sizes.host_bytes, sizes.segments_per_request, {}};
  std::vector<std::unique_ptr<BatchWorker>> workers;
  if (mesh.on_device()) leader.make_host_worker = [mesh, worker] { return make_host_worker(mesh, worker); };
  for (int i = 0; i < workers_per_leader; ++i) {
    workers.push_back(mesh.on_device() ? make_launched_worker<WorkerMemory>(mesh, worker)
                                       : make_host_worker(mesh, worker));
  }
  return std::make_unique<Leader>(mesh, leader, std::move(workers));
}

/// The leaders of a structure, one a queue. Consumers share it, so that one that the structure's end surprises finds
/// everything in place.
class Leaders {
 public:
  /// Where the mesh is on a device, its workers are there too.
  Leaders(const Mesh& mesh, RelationSet relations, const StructureOptions& options)
      : mesh_(mesh), relations_(relations) {
    mesh.simplices(needs_of(relations & face_relations, mesh.dimension()));
    const auto queues = queues_for(relations - face_relations, mesh.dimension(), options.queues);
    const Sizes sizes = sizes_for(mesh, options, std::max(static_cast<int>(queues.size()), 1));
    for (const RelationSet members : queues) leaders_.push_back(make_leader(mesh, members, sizes));
  }

  const Mesh& mesh() const { return mesh_; }
  RelationSet relations() const { return relations_; }
  const std::vector<std::unique_ptr<Leader>>& all() const { return leaders_; }

  /// The leader of one relation, or of the links. There is one, unless it is a face relation.
  Leader& of(RelationSet one) const {
    const auto has = [one](const auto& leader) { return leader->relations().contains(one); };
    return **std::find_if(leaders_.begin(), leaders_.end(), has);
  }

  /// The leaders that have some of the relations wanted.
  std::vector<Leader*> some_of(RelationSet wanted) const {
    std::vector<Leader*> some;
    for (const auto& leader : leaders_) {
      if (!(leader->relations() & wanted).empty()) some.push_back(leader.get());
    }
    return some;
  }

  /// Fails all requests, and returns when their consumers have gone.
  void end() {
    for (const auto& leader : leaders_) leader->end();
  }

 private:
  const Mesh mesh_;
  const RelationSet relations_;
  std::vector<std::unique_ptr<Leader>> leaders_;
};

/// How one consumer of a sweep reads the blocks of one leader: an arena is pinned once for all of its segments that
/// come one after the other, since what many consumers touch for each segment, they wait for.
class SweepReader {
 public:
  /// `runs_ahead`: the leader runs ahead of this sweep, and wants to know what is read.
  SweepReader(Leader& leader, bool runs_ahead) : leader_(&leader), runs_ahead_(runs_ahead) {}
  ~SweepReader() { release(); }
  SweepReader(SweepReader&& other) noexcept
      : leader_(other.leader_),
        runs_ahead_(other.runs_ahead_),
        lease_(std::move(other.lease_)),
        read_(std::exchange(other.read_, 0)) {}

  /// The blocks of a segment, valid until the next call. Waits for them without holding others.
  const Lease& read(Id segment, ConsumerStatistics& statistics) {
    if (leader_->move(lease_, segment)) {
      ++statistics.hits;
    } else {
      release();
      lease_ = leader_->acquire(segment, runs_ahead_, statistics);
    }
    return lease_;
  }

  /// The segment that was read last won't be again.
  void done() { ++read_; }

  const Leader& leader() const { return *leader_; }

 private:
  void release() {
    if (!lease_) return;
    if (!runs_ahead_) {
      lease_.release();
    } else if (lease_.release_read(read_)) {
      leader_->tell_read();
    }
    read_ = 0;
  }

  Leader* leader_;
  bool runs_ahead_;
  Lease lease_;
  Id read_ = 0;  ///< segments of the lease's arena
};

/// A consumer that asks leaders for what it misses, and waits.
class RequestingConsumer : public SegmentConsumer {
 public:
  RequestingConsumer(std::shared_ptr<Leaders> leaders, std::shared_ptr<ConsumerLog> log)
      : SegmentConsumer(leaders->mesh(), leaders->relations(), std::move(log)), leaders_(std::move(leaders)) {}

 private:
  SegmentRows rows_of(RelationSet one, Id segment) override {
    Leader& leader = leaders_->of(one);
    Lease& lease = leases_[all_relations.contains(one) ? static_cast<int>(members_of(one).front()) : relation_count];
    lease.release();
    lease = leader.acquire(segment, false, statistics_);
    SegmentRows rows(segment, mesh_.intervals_of(segment));
    leader.add_rows(lease, rows);
    return rows;
  }

  const std::shared_ptr<Leaders> leaders_;
  Lease leases_[relation_count + 1];  ///< pins on the block read last in each relation; the last is that of links
};

/// Way::leaders: consumers ask, leaders have batches computed, and run ahead of sweeps.
class LeaderStructure : public Structure {
 public:
  /// Throws OutOfMemory where the device has no room for what the leaders need.
  LeaderStructure(const Mesh& mesh, RelationSet relations, const StructureOptions& options)
      : Structure(mesh, relations, Way::leaders), leaders_(std::make_shared<Leaders>(mesh, relations, options)) {}

  /// Ends the leaders. A consumer that still waits gets a gale::Error.
  ~LeaderStructure() override { leaders_->end(); }

  std::unique_ptr<Consumer> consumer() override { return std::make_unique<RequestingConsumer>(leaders_, log()); }

 protected:
  std::unique_ptr<Sweep> begin_sweep(RelationSet wanted, int consumers, const SegmentBody&) override {
    return std::make_unique<LeaderSweep>(*this, wanted, consumers);
  }

  void add_statistics(StructureStatistics& all) const override {
    for (const auto& leader : leaders_->all()) {
      all.leaders.push_back(leader->statistics());
      all.host_bytes += leader->host_bytes();
      all.device_bytes += leader->device_bytes();
      const std::int64_t on_host = all.leaders.back().segments_on_host;
      if (on_host == 0) continue;
      all.notices.push_back(std::to_string(on_host) + " segments of " + name_of(leader->relations()) +
                            " didn't fit the device's memory: the host computed them");
    }
  }

 private:
  /// Has the leaders run ahead as long as it lives; a sweep inside or beside another asks for each segment instead.
  class LeaderSweep : public Sweep {
   public:
    LeaderSweep(LeaderStructure& structure, RelationSet wanted, int consumers)
        : Sweep(consumers),
          mesh_(structure.mesh()),
          faces_(wanted & face_relations),
          leaders_(structure.leaders_->some_of(wanted)),
          sweeping_(structure.sweeping_),
          runs_ahead_(!structure.sweeping_.exchange(true)),
          readers_(consumers) {
      if (!runs_ahead_) return;
      for (Leader* const leader : leaders_) leader->begin_sweep();
    }

    ~LeaderSweep() override {
      readers_.clear();  // readers tell the leaders what they have read
      if (!runs_ahead_) return;
      for (Leader* const leader : leaders_) leader->end_sweep();
      sweeping_ = false;
    }

    void visit(int consumer, Id segment, const SegmentBody& body) override {
      Reader& reader = readers_[consumer];
      if (!reader.ready) prepare(reader);
      SegmentRows rows(segment, mesh_.intervals_of(segment));
      for (auto& blocks : reader.blocks) {
        blocks.leader().add_rows(blocks.read(segment, statistics[consumer]), rows);
      }
      if (reader.faces) reader.faces->compute(rows);
      body(consumer, rows);
      for (auto& blocks : reader.blocks) blocks.done();
    }

   private:
    /// What one consumer works with; made by its thread.
    struct alignas(64) Reader {
      bool ready = false;
      std::vector<SweepReader> blocks;    ///< one for each leader
      std::unique_ptr<HostWorker> faces;  ///< if face relations are wanted
    };

    void prepare(Reader& reader) {
      for (Leader* const leader : leaders_) reader.blocks.emplace_back(*leader, runs_ahead_);
      if (!faces_.empty()) reader.faces = std::make_unique<HostWorker>(mesh_, faces_);
      reader.ready = true;
    }

    const Mesh& mesh_;
    const RelationSet faces_;
    const std::vector<Leader*> leaders_;
    std::atomic<bool>& sweeping_;
    const bool runs_ahead_;
    std::vector<Reader> readers_;
  };

  const std::shared_ptr<Leaders> leaders_;
  std::atomic<bool> sweeping_{false};
};

}  // namespace

std::unique_ptr<Structure> make_leader_structure(const Mesh& mesh, RelationSet relations,
                                                 const StructureOptions& options) {
  return std::make_unique<LeaderStructure>(mesh, relations, options);
}

}  // namespace gale::detail
