// How near a sweep comes to the link: its consumers add up every entry of VV and VT.
//   usage: sweep_rate [N [THREADS...]]

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <gale/runtime/make_structure.hpp>

#include "support/bench_mesh.hpp"
#include "support/clock.hpp"

namespace {

using namespace gale;

std::int64_t sum_of(const Rows& rows, Id first, Id last) {
  const Id* const ids = rows[first].ids;
  const auto count = rows[last - 1].end() - ids;
  std::int64_t sum = 0;
  for (std::ptrdiff_t i = 0; i < count; ++i) sum += ids[i];
  return sum;
}

void measure(const Mesh& mesh, int threads, double link) {
  constexpr int runs = 5;
  constexpr RelationSet wanted = Relation::VV | Relation::VT;
  const auto runtime = make_structure(mesh, wanted);
  std::atomic<std::int64_t> total{0};
  SweepOptions options;
  options.threads = threads;
  const double seconds = perf::median_seconds_of(runs, [&] {
    runtime->for_each_segment(wanted, options, [&](int, const SegmentRows& rows) {
      total += sum_of(rows[Relation::VV], rows.interval(0).first, rows.interval(0).last) +
               sum_of(rows[Relation::VT], rows.interval(0).first, rows.interval(0).last);
    });
  });
  const auto statistics = runtime->statistics();
  double bytes = 0;
  for (const auto& leader : statistics.leaders) bytes += static_cast<double>(leader.bytes) / (runs + 1);
  const double waiting = statistics.all_consumers().waiting.total() / (runs + 1);
  std::printf(
      "%3d consumers: %7.1f ms, %5.1f GB/s, %3.0f %% of the link's %.1f GB/s, waiting %4.1f %% of the consumers' "
      "time\n",
      threads, 1e3 * seconds, bytes / seconds / 1e9, 100 * bytes / seconds / link, link / 1e9,
      100 * waiting / (threads * seconds));
}

}  // namespace

int main(int argc, char** argv) {
  const Kokkos::ScopeGuard kokkos(argc, argv);
  const int n = argc > 1 ? std::atoi(argv[1]) : 64;
  std::vector<int> threads;
  for (int i = 2; i < argc; ++i) threads.push_back(std::atoi(argv[i]));
  if (threads.empty()) threads = {host_threads()};
  const Mesh mesh = perf::encode(io::make_grid(n));
  const double link = perf::link_bandwidth(std::size_t(16) << 20);
  std::printf("%s, grid:%d, %d segments\n", perf::context().c_str(), n, mesh.segments());
  for (const int count : threads) measure(mesh, count, link);
}
