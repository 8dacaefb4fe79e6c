#include <thread>

#include <gale/base/start_thread.hpp>
#include <gale/baselines/task_parallel/pipe.hpp>
#include <gale/baselines/task_parallel/task_parallel_structure.hpp>

namespace gale::detail {

std::unique_ptr<Structure::Sweep> TaskParallelStructure::begin_sweep(RelationSet wanted, int consumers,
                                                                     const SegmentBody& body) {
  /// The sweep's threads compute; the consumers are threads that each read a pipe.
  class PipedSweep : public Sweep {
   public:
    PipedSweep(const Mesh& mesh, RelationSet wanted, int consumers, const SegmentBody& body) : Sweep(consumers) {
      for (int i = 0; i < consumers; ++i) pipes_.push_back(std::make_unique<Pipe>(mesh, wanted, stopped_));
      try {
        for (int i = 0; i < consumers; ++i) {
          threads_.push_back(start_thread([this, i, &body] {
            pipes_[i]->consume([&](const SegmentRows& rows) { body(i, rows); }, statistics[i]);
          }));
        }
      } catch (...) {  // there are no more threads to be had
        join();
        throw;
      }
    }
    ~PipedSweep() override { join(); }

    void visit(int worker, Id segment, const SegmentBody&) override { pipes_[worker]->fill(segment); }

    void end() override {
      join();
      for (const auto& pipe : pipes_) pipe->rethrow();
    }

   private:
    /// Waits until everything is read.
    void join() {
      for (auto& pipe : pipes_) pipe->end();
      for (auto& thread : threads_) thread.join();
      threads_.clear();
    }

    std::atomic<bool> stopped_{false};
    std::vector<std::unique_ptr<Pipe>> pipes_;
    std::vector<std::thread> threads_;
  };
  return std::make_unique<PipedSweep>(mesh(), wanted, consumers, body);
}

}  // namespace gale::detail
