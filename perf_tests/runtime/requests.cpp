// Requests in no order: how long one cold row takes, and how many rows a second consumers get that jump at random, with
// and without a budget that all blocks fit.
//   usage: requests [N [SECONDS]]

#include <cstdio>
#include <cstdlib>
#include <random>
#include <thread>
#include <vector>

#include <gale/runtime/make_structure.hpp>

#include "support/bench_mesh.hpp"
#include "support/clock.hpp"

namespace {

using namespace gale;

void measure_cold_row(const Mesh& mesh) {
  std::vector<double> times;
  std::mt19937 random(1);
  const auto runtime = make_structure(mesh, Relation::VV | Relation::VT);
  const auto consumer = runtime->consumer();
  for (int i = 0; i < 101; ++i) {
    const Id vertex = static_cast<Id>(random() % mesh.vertices());
    times.push_back(perf::seconds_of([&] { consumer->row(Relation::VV, vertex); }));
  }
  std::sort(times.begin() + 1, times.end());
  std::printf("one cold row: %.1f us (median of %zu; the very first %.1f)\n", 1e6 * times[times.size() / 2],
              times.size() - 1, 1e6 * times[0]);
}

void measure_jumps(const Mesh& mesh, int consumers, std::size_t budget, double seconds) {
  StructureOptions options;
  options.host_memory = budget;
  const auto runtime = make_structure(mesh, Relation::VV | Relation::VT, options);
  std::vector<std::thread> threads;
  std::atomic<std::int64_t> rows{0};
  const double elapsed = perf::seconds_of([&] {
    for (int i = 0; i < consumers; ++i) {
      threads.emplace_back([&, i] {
        std::mt19937 random(i);
        const auto consumer = runtime->consumer();
        std::int64_t mine = 0;
        const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
        for (; std::chrono::steady_clock::now() < end; ++mine)
          consumer->row(Relation::VV, static_cast<Id>(random() % mesh.vertices()));
        rows += mine;
      });
    }
    for (auto& thread : threads) thread.join();
  });
  const auto statistics = runtime->statistics();
  const auto all = statistics.all_consumers();
  std::int64_t recomputed = 0, computed = all.segments_computed;
  for (const auto& leader : statistics.leaders)
    computed += leader.segments_computed, recomputed += leader.segments_recomputed;
  std::printf(
      "%3d consumers, %5zu MiB: %9.0f rows/s, %5.1f %% waited for, %lld segments computed, %lld of them again\n",
      consumers, budget >> 20, rows / elapsed,
      100.0 * all.requests / std::max<std::int64_t>(all.requests + all.hits, 1), static_cast<long long>(computed),
      static_cast<long long>(recomputed));
}

}  // namespace

int main(int argc, char** argv) {
  const Kokkos::ScopeGuard kokkos(argc, argv);
  const int n = argc > 1 ? std::atoi(argv[1]) : 64;
  const double seconds = argc > 2 ? std::atof(argv[2]) : 1.0;
  const Mesh mesh = perf::encode(io::make_grid(n));
  std::printf("%s, grid:%d, %d segments\n", perf::context().c_str(), n, mesh.segments());
  measure_cold_row(mesh);
  for (const std::size_t mebibytes : {8192, 64}) {
    for (const int consumers : {1, 2, 4, 8, 16}) measure_jumps(mesh, consumers, mebibytes << 20, seconds);
  }
}
