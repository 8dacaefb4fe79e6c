// Where the time of critical points goes: every step of grid:N, and every kernel and copy below it.
//   usage: critical_points_times [N [RUNS]]

#include <cstdio>
#include <cstdlib>

#include <gale/algorithms/critical_points.hpp>
#include <gale/runtime/make_structure.hpp>

#include "support/initialized.hpp"
#include "support/kernel_times.hpp"

namespace {

void run(const gale::io::Dataset& data) {
  using namespace gale;
  const perf::Initialized input(data);
  std::unique_ptr<Structure> runtime;
  const double start = perf::seconds_of([&] { runtime = make_structure(input.mesh(), critical_points_relations); });
  std::size_t count = 0;
  const double sweep = perf::seconds_of([&] { count = find_critical_points(*runtime, input.order()).vertices.size(); });
  std::printf("segment %.1f, encode %.1f, order %.1f, start %.1f, sweep %.1f ms: %zu critical points\n",
              1e3 * input.segment, 1e3 * input.encode, 1e3 * input.rank, 1e3 * start, 1e3 * sweep, count);
}

}  // namespace

int main(int argc, char** argv) {
  const Kokkos::ScopeGuard kokkos(argc, argv);
  const int n = argc > 1 ? std::atoi(argv[1]) : 128;
  const int runs = argc > 2 ? std::atoi(argv[2]) : 3;
  const auto data = gale::io::make_grid(n);
  for (int i = 0; i < runs; ++i) {
    const gale::perf::KernelTimes times;
    run(data);
    if (i + 1 == runs) times.print();
  }
}
