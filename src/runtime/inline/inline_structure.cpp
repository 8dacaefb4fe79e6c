#include <algorithm>
#include <vector>

#include <gale/relations/kernels/segment_kernel.hpp>
#include <gale/runtime/segment_consumer.hpp>
#include <gale/runtime/ways.hpp>

namespace gale::detail {

SegmentRows compute_counted(HostWorker& worker, Id segment, ConsumerStatistics& statistics) {
  const Stopwatch computing(statistics.seconds_computing);
  const SegmentRows rows = worker.compute(segment);
  ++statistics.segments_computed;
  return rows;
}

namespace {

/// Has what workers read on the host, before several ask for it.
void precondition(const Mesh& mesh, RelationSet relations) {
  if (mesh.grid() == nullptr && !(relations & star_relations_of(mesh.dimension())).empty()) mesh.encoded();
  SimplexNeeds needs = needs_of(relations, mesh.dimension());
  needs.cells |= needs.upto != Enumeration::cells;
  mesh.simplices(needs);
}

/// What one kernel made last for a consumer, for some segments.
class RecentBlocks {
 public:
  /// `mesh` must outlive it.
  RecentBlocks(const Mesh& mesh, RelationSet relations) : mesh_(&mesh), relations_(relations) {}

  RelationSet relations() const { return relations_; }

  /// The rows of a segment. Those of `one`, a relation or the links, are valid until the next call for the same.
  const SegmentRows& rows_of(RelationSet one, Id segment, ConsumerStatistics& statistics) {
    for (Kept& kept : kept_) kept.readers = kept.readers - one;
    Kept& kept = find(segment);
    kept.readers = kept.readers | one;
    kept.last_use = ++now_;
    if (kept.rows.segment() == segment) {
      ++statistics.hits;
    } else {
      kept.rows = SegmentRows();
      kept.rows = compute_counted(kept.worker, segment, statistics);
    }
    return kept.rows;
  }

 private:
  /// More than relations that one kernel makes, of each of which the block read last stays.
  static constexpr std::size_t capacity = 32;

  struct Kept {
    HostWorker worker;
    SegmentRows rows;
    RelationSet readers;  ///< whose row was read here last
    std::int64_t last_use = 0;
  };

  /// Where the segment's blocks are kept, or where they may be.
  Kept& find(Id segment) {
    Kept* oldest = nullptr;
    for (Kept& kept : kept_) {
      if (kept.rows.segment() == segment) return kept;
      if (kept.readers.empty() && (oldest == nullptr || kept.last_use < oldest->last_use)) oldest = &kept;
    }
    if (kept_.size() == capacity) return *oldest;
    kept_.push_back({HostWorker(*mesh_, relations_), SegmentRows(), RelationSet(), 0});
    return kept_.back();
  }

  const Mesh* mesh_;
  RelationSet relations_;
  std::vector<Kept> kept_;
  std::int64_t now_ = 0;
};

/// A consumer that computes what it misses and keeps the blocks of the segments that it read last.
class InlineConsumer : public SegmentConsumer {
 public:
  InlineConsumer(const Mesh& mesh, RelationSet relations, std::shared_ptr<ConsumerLog> log)
      : SegmentConsumer(mesh, relations, std::move(log)) {
    for (const RelationSet kernel : kernels_for(relations - face_relations, mesh.dimension()))
      blocks_.emplace_back(mesh, kernel);
  }

 private:
  SegmentRows rows_of(RelationSet one, Id segment) override {
    const auto has = [one](const RecentBlocks& blocks) { return blocks.relations().contains(one); };
    return std::find_if(blocks_.begin(), blocks_.end(), has)->rows_of(one, segment, statistics_);
  }

  std::vector<RecentBlocks> blocks_;  ///< by kernel
};

}  // namespace

InlineStructure::InlineStructure(const Mesh& mesh, RelationSet relations, Way way) : Structure(mesh, relations, way) {
  precondition(mesh, relations);
}

std::unique_ptr<Consumer> InlineStructure::consumer() {
  return std::make_unique<InlineConsumer>(mesh(), relations(), log());
}

std::unique_ptr<Structure::Sweep> InlineStructure::begin_sweep(RelationSet wanted, int consumers, const SegmentBody&) {
  class InlineSweep : public Sweep {
   public:
    InlineSweep(const Mesh& mesh, RelationSet wanted, int consumers)
        : Sweep(consumers), mesh_(mesh), wanted_(wanted), workers_(consumers) {}

    void visit(int consumer, Id segment, const SegmentBody& body) override {
      auto& worker = workers_[consumer];
      if (!worker) worker = std::make_unique<HostWorker>(mesh_, wanted_);
      body(consumer, compute_counted(*worker, segment, statistics[consumer]));
    }

   private:
    const Mesh& mesh_;
    const RelationSet wanted_;
    std::vector<std::unique_ptr<HostWorker>> workers_;  ///< each made by the thread that uses it
  };
  return std::make_unique<InlineSweep>(mesh(), wanted, consumers);
}

}  // namespace gale::detail
