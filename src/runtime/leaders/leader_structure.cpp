#include <gale/relations/host_worker.hpp>
#include <gale/runtime/leaders/leader_structure.hpp>
#include <gale/runtime/leaders/requesting_consumer.hpp>
#include <gale/runtime/leaders/sweep_reader.hpp>

namespace gale::detail {

/// Has the leaders run ahead as long as it lives; a sweep inside or beside another asks for each segment instead.
class LeaderStructure::LeaderSweep : public Sweep {
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
    readers_.clear();  // they tell the leaders what they have read
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

LeaderStructure::LeaderStructure(const Mesh& mesh, RelationSet relations, const StructureOptions& options)
    : Structure(mesh, relations, Way::leaders), leaders_(std::make_shared<Leaders>(mesh, relations, options)) {}

LeaderStructure::~LeaderStructure() { leaders_->end(); }

std::unique_ptr<Consumer> LeaderStructure::consumer() { return std::make_unique<RequestingConsumer>(leaders_, log()); }

std::unique_ptr<Structure::Sweep> LeaderStructure::begin_sweep(RelationSet wanted, int consumers, const SegmentBody&) {
  return std::make_unique<LeaderSweep>(*this, wanted, consumers);
}

void LeaderStructure::add_statistics(StructureStatistics& all) const {
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

}  // namespace gale::detail
