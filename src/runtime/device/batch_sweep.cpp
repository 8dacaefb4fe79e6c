#include <algorithm>
#include <deque>
#include <vector>

#include <gale/base/error.hpp>
#include <gale/relations/preconditioning.hpp>
#include <gale/runtime/batches/batch_lane.hpp>
#include <gale/runtime/defaults.hpp>
#include <gale/runtime/device/batch_sweep.hpp>

namespace gale::detail {

namespace {

/// Rows beyond those of a regular mesh, at first.
constexpr double margin = 1.2;

/// Options, with what they leave open filled in.
template <class Memory>
struct Filled {
  std::size_t memory;
  int batches, threads_per_segment;

  explicit Filled(const DeviceSweepOptions& options)
      : memory(options.memory != 0 ? options.memory : (is_device_memory<Memory> ? 96 : 4) * mebibyte),
        batches(given_or(options.batches, is_device_memory<Memory> ? 3 : 1, "batches")),
        threads_per_segment(given_or(options.threads_per_segment, 128, "threads per segment")) {
    given_or(options.threads_per_team, 1, "threads per team");
  }
};

}  // namespace

void require_sweep(RelationSet relations, const DeviceSweepOptions& options) {
  if (relations.empty()) throw Error("a sweep needs a relation to read");
  const Filled<HostMemory> filled(options);
}

/// The batches of a sweep: what is planned, and what is under way.
template <class Memory>
class BatchSweep<Memory>::Batches {
 public:
  using Lane = BatchLane<Memory>;

  Batches(const Mesh& mesh, RelationSet relations, const DeviceSweepOptions& options)
      : mesh_(mesh), words_per_vertex_(margin * words_per_vertex(relations)), ahead_(mesh.owned_segments().first) {
    require_sweep(relations, options);
    gale::require_relations(relations, mesh.dimension());
    const Filled<Memory> filled(options);
    const auto kernels = std::make_shared<typename Lane::Kernels>();
    for (const RelationSet one : kernels_for(relations, mesh.dimension()))
      kernels->emplace_back(mesh, one, filled.threads_per_segment);
    words_ = std::max<Offset>(static_cast<Offset>(filled.memory / filled.batches / sizeof(Id)), 1024);
    const auto all = static_cast<Offset>(words_per_vertex_ * mesh.owned_vertices().size()) + 1024;
    room_ = std::min(words_, all);
    const auto batches = static_cast<int>(std::min<Offset>(filled.batches, (all + words_ - 1) / words_));
    for (int i = 0; i < batches; ++i) {
      try {
        lanes_.push_back(std::make_unique<Lane>(mesh_, kernels, room_, BatchReader::kernels));
      } catch (const OutOfMemory&) {
        if (lanes_.empty()) throw;
        break;  // fewer do as well
      }
    }
  }

  /// The lane of the next batch, launched; nullptr when all are done.
  const Lane* next() {
    for (std::size_t waited = 0; waited < lanes_.size();) {
      Lane& lane = *lanes_[turn_];
      turn_ = (turn_ + 1) % lanes_.size();
      if (lane.in_flight()) finish(lane);
      if (again_.empty() && ahead_ == mesh_.owned_segments().last) {
        ++waited;
        continue;
      }
      launch(lane, next_plan());
      if (lane.in_flight()) return &lane;
      waited = 0;
    }
    return nullptr;
  }

 private:
  /// Takes segments as far as they fit.
  BatchPlan next_plan() {
    BatchPlan plan;
    if (!again_.empty()) {
      plan = std::move(again_.front());
      again_.pop_front();
      return plan;
    }
    const auto& vertex_begin = mesh_.vertex_begin();
    const double most = static_cast<double>(words_) / words_per_vertex_;
    plan.words = room_;
    plan.begin = ahead_++;
    while (ahead_ < mesh_.owned_segments().last && vertex_begin(ahead_ + 1) - vertex_begin(plan.begin) <= most)
      ++ahead_;
    plan.end = ahead_;
    return plan;
  }

  /// Launches a plan, or plans its halves if the memory for more than the lane has isn't there.
  void launch(Lane& lane, const BatchPlan& plan) {
    try {
      lane.launch(plan);
    } catch (const OutOfMemory&) {
      if (plan.count() == 1) throw;
      plan_again(plan, all_of(plan));
    }
  }

  void finish(Lane& lane) {
    const BatchShortfall lacked = lane.finish();
    const BatchPlan& plan = lane.plan();
    if (plan.begin < plan.end) {
      const auto& begin = mesh_.vertex_begin();
      const double words =
          1.05 * static_cast<double>(lacked.words) / std::max(begin(plan.end) - begin(plan.begin), Id(1));
      words_per_vertex_ = std::max(words, 0.5 * (words_per_vertex_ + words));
    }
    if (!lacked.segments.empty()) plan_again(plan, lacked);
  }

  void plan_again(const BatchPlan& plan, const BatchShortfall& lacked) {
    for (BatchPlan& half : in_halves(plan, lacked)) again_.push_back(std::move(half));
  }

  const Mesh mesh_;
  double words_per_vertex_;  ///< that blocks take, by those so far
  Offset words_ = 0;         ///< that a batch is planned for
  Offset room_ = 0;          ///< words that one has, unless one segment needs more; fewer where the mesh takes fewer
  std::vector<std::unique_ptr<Lane>> lanes_;
  std::size_t turn_ = 0;         ///< the lane that is next
  Id ahead_;                     ///< the first segment that no batch had yet
  std::deque<BatchPlan> again_;  ///< plans of segments that lacked room
};

template <class Memory>
BatchSweep<Memory>::BatchSweep(const Mesh& mesh, RelationSet relations, const DeviceSweepOptions& options)
    : batches_(new Batches(mesh, relations, options)) {}

template <class Memory>
BatchSweep<Memory>::~BatchSweep() = default;

template <class Memory>
auto BatchSweep<Memory>::next() -> std::optional<Launched> {
  const BatchLane<Memory>* const lane = batches_->next();
  if (lane == nullptr) return std::nullopt;
  return Launched{lane->instance(), lane->launched()};
}

#define GALE_INSTANTIATE(Space) template class GALE_EXPORT BatchSweep<MemoryOf<Space>>
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
