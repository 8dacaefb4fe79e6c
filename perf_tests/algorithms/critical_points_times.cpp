// Where the time of critical points goes: every step of grid:N, and every kernel and copy below it.
//   usage: critical_points_times [N [RUNS]]

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include <gale/algorithms/critical_points.hpp>
#include <gale/io/synthetic.hpp>
#include <gale/runtime/runtime.hpp>

#include "support/kernel_times.hpp"

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point begin) { return 1e3 * std::chrono::duration<double>(Clock::now() - begin).count(); }

void run(const gale::io::Dataset& data) {
  using namespace gale;
  const auto& points = std::get<io::Dataset::Points<float>>(data.points);
  const auto& field = std::get<std::vector<float>>(data.arrays[0].values);
  auto begin = Clock::now();
  const Segmentation segmentation = octree_segmentation(Points<float, HostMemory>(points), 100);
  const double segment = milliseconds_since(begin);
  begin = Clock::now();
  const Mesh mesh(Tetrahedra<Id, HostMemory>(data.tetrahedra), segmentation);
  const double encode = milliseconds_since(begin);
  begin = Clock::now();
  const VertexOrder order(mesh, field.data(), field.size());
  const double rank = milliseconds_since(begin);
  begin = Clock::now();
  Runtime runtime(mesh, critical_points_relations);
  const double start = milliseconds_since(begin);
  begin = Clock::now();
  const auto critical = find_critical_points(runtime, order);
  const double sweep = milliseconds_since(begin);
  std::printf("segment %.1f, encode %.1f, order %.1f, start %.1f, sweep %.1f ms: %zu critical points\n", segment, encode, rank, start, sweep,
              critical.vertices.size());
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
