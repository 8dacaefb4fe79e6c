#include <algorithm>
#include <mutex>

#include <gale/runtime/defaults.hpp>
#include <gale/runtime/helpers/helped_sweep.hpp>
#include <gale/runtime/ways.hpp>

namespace gale::detail {

namespace {

/// Segments for each helper, at least: fewer take no longer than starting it.
constexpr Id worth_a_thread = 8;

/// The cores that a sweep takes for helpers since it leaves them idle, as long as this lives. Sweeps that run at once,
/// also of other structures, share them.
class IdleCores {
 public:
  /// Takes `cores` cores, of which the sweep's consumers use some, and for helpers at most `at_most`.
  IdleCores(int cores, int consumers, int at_most) {
    const std::lock_guard<std::mutex> lock(mutex_);
    count_ = std::clamp(cores - in_use_ - consumers, 0, std::max(at_most, 0));
    claimed_ = consumers + count_;
    in_use_ += claimed_;
  }
  ~IdleCores() {
    const std::lock_guard<std::mutex> lock(mutex_);
    in_use_ -= claimed_;
  }
  IdleCores(const IdleCores&) = delete;
  IdleCores& operator=(const IdleCores&) = delete;

  int count() const { return count_; }

 private:
  inline static std::mutex mutex_;
  inline static int in_use_ = 0;
  int count_, claimed_;
};

/// Way::helpers: inline; and in a sweep, helpers on the cores that it leaves idle compute ahead of the consumers.
class HelpedStructure : public InlineStructure {
 public:
  HelpedStructure(const Mesh& mesh, RelationSet relations, const StructureOptions& options)
      : InlineStructure(mesh, relations, Way::helpers), options_(options) {}

 protected:
  std::unique_ptr<Sweep> begin_sweep(RelationSet wanted, int consumers, const SegmentBody& body) override {
    const int all = cores(options_);
    auto idle = std::make_unique<IdleCores>(all, consumers, mesh().owned_segments().size() / worth_a_thread);
    if (idle->count() == 0) return InlineStructure::begin_sweep(wanted, consumers, body);
    const MakeWorker make = [this, wanted](ConsumerStatistics& statistics, int kept) {
      return std::make_unique<SegmentWorker>(mesh(), wanted, statistics, kept);
    };
    return std::make_unique<HelpedTurns>(*this, std::move(idle), consumers, make, host_memory(options_) / all);
  }

  void add_statistics(StructureStatistics& all) const override {
    const std::lock_guard<std::mutex> lock(mutex_);
    all.helpers = helpers_;
    all.host_bytes = host_bytes_;
  }

 private:
  /// A sweep with helpers: as many turns as segments; which one is read in a turn shows then.
  class HelpedTurns : public Sweep {
   public:
    HelpedTurns(HelpedStructure& structure, std::unique_ptr<IdleCores> idle, int consumers, const MakeWorker& make,
                std::size_t budget_of_each)
        : Sweep(consumers),
          structure_(structure),
          idle_(std::move(idle)),
          helped_(structure.mesh().owned_segments(), consumers, make, idle_->count(), make, budget_of_each) {}

    void visit(int consumer, Id, const SegmentBody& body) override {
      helped_.read_next(consumer, [&](const SegmentRows& rows) { body(consumer, rows); });
    }

    void end() override {
      helped_.end();
      statistics = helped_.of_consumers();
      const std::lock_guard<std::mutex> lock(structure_.mutex_);
      structure_.helpers_ += helped_.of_helpers();
      structure_.host_bytes_ = std::max(structure_.host_bytes_, helped_.block_bytes());
    }

   private:
    HelpedStructure& structure_;
    const std::unique_ptr<IdleCores> idle_;
    HelpedSweep helped_;
  };

  const StructureOptions options_;
  mutable std::mutex mutex_;
  HelperStatistics helpers_;
  std::size_t host_bytes_ = 0;
};

}  // namespace

std::unique_ptr<Structure> make_helped_structure(const Mesh& mesh, RelationSet relations,
                                                 const StructureOptions& options) {
  return std::make_unique<HelpedStructure>(mesh, relations, options);
}

}  // namespace gale::detail
