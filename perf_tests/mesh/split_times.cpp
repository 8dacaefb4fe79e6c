// Hexahedra as tetrahedra: the cells of grid:N, (N - 1)^3 cubes, split where the workers are, beside their upload.
// Medians of five runs after one that isn't counted.
//   usage: split_times [N]

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>

#include <gale/mesh/cells/split_cells.hpp>

#include "support/clock.hpp"

namespace {

using namespace gale;

constexpr int runs = 5;
constexpr std::uint8_t hexahedron = 12;  // as VTK numbers it

template <class Seconds>
double median_ms(std::array<Seconds, runs>& all) {
  std::sort(all.begin(), all.end());
  return 1e3 * all[runs / 2];
}

}  // namespace

int main(int argc, char** argv) {
  const Kokkos::ScopeGuard kokkos(argc, argv);
  const Id n = argc > 1 ? std::atoi(argv[1]) : 256;
  const Id side = n - 1;
  const Offset cubes = Offset(side) * side * side;
  using Memory = WorkerSpace::memory_space;
  const Kokkos::View<std::uint8_t*, Kokkos::HostSpace> types("types", cubes);
  const Kokkos::View<Offset*, Kokkos::HostSpace> offsets("offsets", cubes + 1);
  const Kokkos::View<std::int32_t*, Kokkos::HostSpace> corners("corners", 8 * cubes);
  for (Offset c = 0; c < cubes; ++c) {
    const Id x = c % side, y = c / side % side, z = c / side / side;
    const Id low = (z * n + y) * n + x;
    const Id around[8] = {0, 1, n + 1, n, n * n, n * n + 1, n * n + n + 1, n * n + n};
    types(c) = hexahedron;
    offsets(c) = 8 * c;
    for (int k = 0; k < 8; ++k) corners(8 * c + k) = low + around[k];
  }
  offsets(cubes) = 8 * cubes;

  std::array<double, runs> upload, split;
  Offset made = 0;
  for (int r = -1; r < runs; ++r) {
    Cells<std::int32_t, Memory> cells;
    const double uploaded = perf::seconds_of([&] {
      cells = {Kokkos::create_mirror_view_and_copy(Memory(), types),
               Kokkos::create_mirror_view_and_copy(Memory(), offsets),
               Kokkos::create_mirror_view_and_copy(Memory(), corners)};
    });
    const double took = perf::seconds_of([&] {
      made = split_cells(cells, Offset(n) * n * n).simplices.extent(0);
      Kokkos::fence();
    });
    if (r >= 0) upload[r] = uploaded, split[r] = took;
  }
  std::printf("%lld hexahedra, %lld tetrahedra: upload %.2f ms, split %.2f ms\n", static_cast<long long>(cubes),
              static_cast<long long>(made), median_ms(upload), median_ms(split));
}
