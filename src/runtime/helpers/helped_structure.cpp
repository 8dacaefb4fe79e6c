#include <algorithm>
#include <mutex>

#include <gale/runtime/helpers/helped_sweep.hpp>
#include <gale/runtime/implementation.hpp>
#include <gale/runtime/leaders/defaults.hpp>
#include <gale/runtime/sweep.hpp>

namespace gale::detail {

namespace {

/// The cores that a sweep takes for helpers since it leaves them idle, as long as it lives. Sweeps that run at once,
/// also of other runtimes, share them.
class IdleCores {
 public:
  IdleCores(int cores, int consumers, int at_most) {
    const std::lock_guard<std::mutex> lock(mutex_);
    count_ = std::clamp(cores - in_use_ - consumers, 0, at_most);
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

/// Consumers that compute for themselves; in a sweep with helpers on the cores that it leaves idle.
class HelperProduction : public RuntimeImplementation {
 public:
  HelperProduction(const Mesh& mesh, RelationSet relations, const RuntimeOptions& options)
      : RuntimeImplementation(mesh, relations), alone_(by_consumers(mesh, relations)), options_(options) {
    cores(options);  // refuses what isn't a number of cores
  }

  void for_each_segment(RelationSet wanted, const SweepOptions& options, const Structure::SegmentBody& body) override {
    const int all = cores(options_);
    const IdleCores idle(all, std::max(options.threads, 0), mesh().segments() / worth_a_thread);
    if (idle.count() == 0) return alone_->for_each_segment(wanted, options, body);
    const MakeWorker make = [&](ConsumerStatistics& statistics, int kept) {
      return std::make_unique<CountingWorker>(mesh(), wanted, statistics, kept);
    };
    HelpedSweep helped(mesh().segments(), std::max(options.threads, 0), make, idle.count(), make,
                       host_memory(options_) / all);
    // As many turns as segments; which one is read in a turn shows then.
    sweep(mesh().segments(), options, [&](int consumer, Id) {
      helped.read_next(consumer, [&](const SegmentRows& rows) { body(consumer, rows); });
    });
    helped.end();
    for (const auto& one : helped.of_consumers()) log_.add(one);
    const std::lock_guard<std::mutex> lock(mutex_);
    helpers_ += helped.of_helpers();
    host_bytes_ = std::max(host_bytes_, helped.block_bytes());
  }

  std::unique_ptr<Consumer> consumer() override { return alone_->consumer(); }
  Way way() const override { return Way::helpers; }

  RuntimeStatistics statistics() const override {
    RuntimeStatistics all = alone_->statistics();
    const auto helped = log_.all();
    all.consumers.insert(all.consumers.end(), helped.begin(), helped.end());
    const std::lock_guard<std::mutex> lock(mutex_);
    all.helpers = helpers_;
    all.host_bytes = host_bytes_;
    return all;
  }

 private:
  /// Segments for each helper, at least: fewer take no longer than starting it.
  static constexpr Id worth_a_thread = 8;

  const std::unique_ptr<RuntimeImplementation> alone_;
  const RuntimeOptions options_;
  ConsumerLog log_;
  mutable std::mutex mutex_;
  HelperStatistics helpers_;
  std::size_t host_bytes_ = 0;
};

}  // namespace

std::unique_ptr<RuntimeImplementation> by_helpers(const Mesh& mesh, RelationSet relations,
                                                  const RuntimeOptions& options) {
  return std::make_unique<HelperProduction>(mesh, relations, options);
}

}  // namespace gale::detail
