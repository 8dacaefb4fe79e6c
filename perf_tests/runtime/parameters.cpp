// The paper's studies, with critical points: threads per block, blocks per request, threads per segment, consumers, and
// one queue for both relations against one each.
//   usage: parameters [N]

#include <cstdio>
#include <cstdlib>

#include <gale/algorithms/critical_points.hpp>
#include <gale/runtime/make_structure.hpp>

#include "support/bench_mesh.hpp"
#include "support/clock.hpp"

namespace {

using namespace gale;

struct Study {
  const Mesh& mesh;
  const VertexOrder& order;

  void row(const char* what, int value, const StructureOptions& options, int threads) const {
    const auto runtime = make_structure(mesh, critical_points_relations, options);
    SweepOptions sweep;
    sweep.threads = threads;
    constexpr int runs = 5;
    const double seconds = perf::median_seconds_of(runs, [&] { find_critical_points(*runtime, order, sweep); });
    const auto statistics = runtime->statistics();
    const auto waiting = statistics.all_consumers().waiting;
    std::int64_t batches = 0, segments = 0;
    for (const auto& leader : statistics.leaders) batches += leader.batches, segments += leader.segments_computed;
    const double mean = 1e3 / ((runs + 1) * threads);
    std::printf(
        "%-20s %5d: %7.1f ms; ms a consumer waited: %6.2f = %.2f push + %.2f queue + %.2f preparation + %.2f "
        "production + %.2f integration; "
        "%lld segments a batch\n",
        what, value, 1e3 * seconds, mean * waiting.total(), mean * waiting.push, mean * waiting.queue,
        mean * waiting.preparation, mean * waiting.kernel_and_transfer, mean * waiting.integration,
        static_cast<long long>(segments / std::max<std::int64_t>(batches, 1)));
  }
};

}  // namespace

int main(int argc, char** argv) {
  const Kokkos::ScopeGuard kokkos(argc, argv);
  const int n = argc > 1 ? std::atoi(argv[1]) : 64;
  const auto data = io::make_grid(n);
  const Mesh mesh = perf::encode(data);
  const auto& field = std::get<std::vector<float>>(data.arrays[0].values);
  const VertexOrder order(mesh, field.data(), field.size());
  const Study study{mesh, order};
  const int all = host_threads();
  std::printf("%s, grid:%d, %d segments\n", perf::context().c_str(), n, mesh.segments());
  StructureOptions options;
  options.way = Way::leaders;
  for (int threads = 1; threads <= all; threads *= 2) study.row("consumers", threads, options, threads);
  for (const int t_s : {32, 64, 96, 128, 256, 512}) {
    options.threads_per_segment = t_s;
    study.row("threads per segment", t_s, options, all);
  }
  options.threads_per_segment = 0;
  for (const int t_b : {32, 64, 128, 256, 512, 1024}) {
    options.threads_per_block = t_b;
    study.row("threads per block", t_b, options, all);
  }
  options.threads_per_block = 0;
  for (const int n_b : {1, 2, 4, 8, 16, 32}) {
    options.blocks_per_request = n_b;
    study.row("blocks per request", n_b, options, all);
  }
  options.blocks_per_request = 0;
  options.queues = Queues::per_relation;
  study.row("a queue a relation", 2, options, all);
  options.queues = Queues::per_kernel;
  options.way = Way::inline_;
  study.row("no leader", 0, options, all);
}
