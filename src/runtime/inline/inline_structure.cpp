#include <algorithm>
#include <vector>

#include <gale/relations/face_reader.hpp>
#include <gale/relations/kernels/segment_kernel.hpp>
#include <gale/runtime/implementation.hpp>
#include <gale/runtime/inline/counting_worker.hpp>
#include <gale/runtime/sweep.hpp>

namespace gale::detail {

namespace {

/// What one kernel made last, for some segments.
class RecentBlocks {
 public:
  RecentBlocks(const Mesh& mesh, RelationSet relations) : mesh_(mesh), relations_(relations) {}

  bool has(Relation relation) const { return relations_.has(relation); }

  /// Valid until the next call for the same relation.
  const SegmentRows& rows_of(Relation relation, Id segment, ConsumerStatistics& statistics) {
    for (Kept& one : kept_) one.readers = one.readers - relation;
    Kept& kept = find(segment, statistics);
    kept.readers = kept.readers | relation;
    kept.last_use = ++now_;
    if (kept.rows.segment() == segment) {
      ++statistics.hits;
    } else {
      kept.rows = SegmentRows();
      kept.rows = kept.worker.compute(segment);
    }
    return kept.rows;
  }

 private:
  /// More than relations that one kernel makes, of each of which the block read last stays.
  static constexpr std::size_t capacity = 32;

  struct Kept {
    CountingWorker worker;
    SegmentRows rows;
    RelationSet readers;  ///< whose row was read here last
    std::int64_t last_use = 0;
  };

  /// Where the segment's blocks are kept, or where they may be.
  Kept& find(Id segment, ConsumerStatistics& statistics) {
    Kept* oldest = nullptr;
    for (Kept& one : kept_) {
      if (one.rows.segment() == segment) return one;
      if (one.readers.empty() && (oldest == nullptr || one.last_use < oldest->last_use)) oldest = &one;
    }
    if (kept_.size() == capacity) return *oldest;
    kept_.push_back({CountingWorker(mesh_, relations_, statistics), SegmentRows(), RelationSet(), 0});
    return kept_.back();
  }

  const Mesh& mesh_;
  RelationSet relations_;
  std::vector<Kept> kept_;
  std::int64_t now_ = 0;
};

/// A consumer that computes what it misses and keeps the blocks of the segments that it read last.
class InlineConsumer : public Consumer {
 public:
  InlineConsumer(const Mesh& mesh, RelationSet relations, ConsumerLog& log)
      : mesh_(mesh), relations_(relations), faces_(mesh, relations & face_relations), log_(log) {
    for (const RelationSet one : kernels_for(relations - face_relations)) blocks_.emplace_back(mesh, one);
  }
  ~InlineConsumer() override { log_.add(statistics_); }

 protected:
  SegmentRows load(Relation relation, Id simplex) override {
    require_preconditioned(relations_, relation);
    require_simplex(mesh_, row_dimension(relation), simplex);
    if (face_relations.has(relation)) return faces_.row(relation, simplex);
    const Id segment = mesh_.segment_of(row_dimension(relation), simplex);
    const auto has = [relation](const RecentBlocks& blocks) { return blocks.has(relation); };
    return std::find_if(blocks_.begin(), blocks_.end(), has)->rows_of(relation, segment, statistics_);
  }

 private:
  const Mesh& mesh_;
  RelationSet relations_;
  FaceReader faces_;
  ConsumerLog& log_;
  ConsumerStatistics statistics_;
  std::vector<RecentBlocks> blocks_;  ///< by kernel
};

/// Has what workers on the host read there, before several ask for it.
void precondition(const Mesh& mesh, RelationSet relations) {
  if (!(relations & star_relations).empty()) mesh.encoded();
  SimplexNeeds needs = needs_of(relations);
  needs.tetrahedra |= needs.upto != Enumeration::tetrahedra;
  mesh.simplices(needs);
}

struct SweepConsumer {
  ConsumerStatistics statistics;
  CountingWorker worker;

  SweepConsumer(const Mesh& mesh, RelationSet wanted) : worker(mesh, wanted, statistics) {}
};

class ConsumerProduction : public RuntimeImplementation {
 public:
  ConsumerProduction(const Mesh& mesh, RelationSet relations) : RuntimeImplementation(mesh, relations) {
    precondition(mesh, relations);
  }

  void for_each_segment(RelationSet wanted, const SweepOptions& options, const Structure::SegmentBody& body) override {
    std::vector<std::unique_ptr<SweepConsumer>> consumers(std::max(options.threads, 0));
    sweep(mesh().segments(), options, [&](int number, Id segment) {
      auto& consumer = consumers[number];
      if (!consumer) consumer = std::make_unique<SweepConsumer>(mesh(), wanted);
      body(number, consumer->worker.compute(segment));
    });
    for (const auto& consumer : consumers) log_.add(consumer ? consumer->statistics : ConsumerStatistics());
  }

  std::unique_ptr<Consumer> consumer() override { return std::make_unique<InlineConsumer>(mesh(), relations(), log_); }

  Way way() const override { return Way::inline_; }

  RuntimeStatistics statistics() const override {
    RuntimeStatistics all;
    all.consumers = log_.all();
    return all;
  }

 private:
  ConsumerLog log_;
};

}  // namespace

std::unique_ptr<RuntimeImplementation> by_consumers(const Mesh& mesh, RelationSet relations) {
  return std::make_unique<ConsumerProduction>(mesh, relations);
}

}  // namespace gale::detail
