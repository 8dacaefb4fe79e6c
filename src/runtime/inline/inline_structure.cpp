#include <chrono>

#include <gale/runtime/inline/inline_consumer.hpp>
#include <gale/runtime/inline/inline_structure.hpp>

namespace gale::detail {

namespace {

/// Has what workers read on the host, before several ask for it.
void precondition(const Mesh& mesh, RelationSet relations) {
  if (!(relations & star_relations).empty()) mesh.encoded();
  SimplexNeeds needs = needs_of(relations);
  needs.tetrahedra |= needs.upto != Enumeration::tetrahedra;
  mesh.simplices(needs);
}

}  // namespace

SegmentRows compute_counted(HostWorker& worker, Id segment, ConsumerStatistics& statistics) {
  const auto begin = std::chrono::steady_clock::now();
  const SegmentRows rows = worker.compute(segment);
  statistics.seconds_computing += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  ++statistics.segments_computed;
  return rows;
}

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
