// Sweeps whose consumers are kernels, over all of grid:N: each relation's rows made and left unread, and read by a
// functor that adds up a value for each entry, by the memory for batches; beside what the rows' bytes take of the
// memory's bandwidth. Critical points and gradient in the same way.
//   usage: device_sweep_rates [N [RELATION...]]

#include <cstdio>
#include <cstdlib>
#include <vector>

#include <gale/algorithms/critical_points.hpp>
#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/relations/preconditioning.hpp>
#include <gale/runtime/device_sweep.hpp>
#include <gale/runtime/graph_of.hpp>

#include "support/bench_mesh.hpp"
#include "support/clock.hpp"

namespace {

using namespace gale;

using Memory = detail::MemoryOfSweep<WorkerSpace>;
constexpr std::size_t mebi = std::size_t(1) << 20;
constexpr int runs = 5;

struct ReadNothing {
  template <class Team>
  KOKKOS_FUNCTION void operator()(const Team&, const SegmentRowsIn<Memory>&) const {}
};

struct AddValues {
  Kokkos::View<const float*, Memory> values;
  Kokkos::View<float*, Memory> sums;

  KOKKOS_FUNCTION void operator()(Id simplex, const Row& row) const {
    float sum = 0;
    for (const Id id : row) sum += values(id);
    sums(simplex) = sum;
  }
};

/// Bytes a second of copies within the workers' memory, read and written.
double memory_bandwidth() {
  const std::size_t bytes = (have_device ? 1024 : 64) * mebi;
  const Kokkos::View<char*, WorkerMemory> from("from", bytes), to("to", bytes);
  const double seconds = perf::median_seconds_of(runs, [&] {
    Kokkos::deep_copy(to, from);
    WorkerSpace().fence();
  });
  return 2.0 * static_cast<double>(bytes) / seconds;
}

DeviceSweepOptions with_memory(std::size_t bytes) {
  DeviceSweepOptions options;
  options.memory = bytes;
  return options;
}

void measure(const Mesh& mesh, Relation relation, double bandwidth) {
  const auto graph = graph_of(WorkerSpace(), mesh, relation);
  const double bytes = 4.0 * static_cast<double>(graph.entries.extent(0) + graph.offsets.extent(0));
  mesh.simplices<Memory>(needs_of(RelationSet(relation)));
  const Id entries = mesh.interval_begin(entry_dimension(relation))(mesh.segments());
  const AddValues add{Kokkos::View<float*, Memory>("values", entries),
                      Kokkos::View<float*, Memory>("sums", graph.offsets.extent(0))};
  for (const std::size_t memory : {std::size_t(0), 24 * mebi, 48 * mebi, 96 * mebi, 384 * mebi, 1536 * mebi}) {
    const auto options = with_memory(memory);
    const double made =
        perf::median_seconds_of(runs, [&] { for_each_segment(WorkerSpace(), mesh, relation, ReadNothing(), options); });
    const double read =
        perf::median_seconds_of(runs, [&] { for_each_row(WorkerSpace(), mesh, relation, add, options); });
    std::printf("%-4s %5zu MiB: made %7.2f ms, made and read %7.2f ms (%.2f); %.2f GB, at the memory's %.1f ms\n",
                name_of(relation).c_str(), memory / mebi, 1e3 * made, 1e3 * read, read / made, bytes / 1e9,
                1e3 * bytes / bandwidth);
    std::fflush(stdout);
  }
}

/// What a sweep takes however small the mesh.
void measure_overhead() {
  const Mesh mesh = perf::encode(io::make_grid(8));
  const double seconds = perf::median_seconds_of(
      runs, [&] { for_each_segment(WorkerSpace(), mesh, critical_points_relations, ReadNothing()); });
  std::printf("a sweep over grid:8: %.2f ms\n", 1e3 * seconds);
}

/// What it takes before its first batch.
void measure_set_up(const Mesh& mesh) {
  const double seconds = perf::median_seconds_of(
      runs, [&] { const detail::BatchSweep<Memory> sweep(mesh, critical_points_relations, {}); });
  std::printf("set up for VV and link: %.2f ms\n", 1e3 * seconds);
}

void measure_gradient(const Mesh& mesh, const VertexOrder& order) {
  for (const std::size_t memory : {std::size_t(0), 48 * mebi, 384 * mebi, 1536 * mebi}) {
    for (const int batches : {2, 3, 6}) {
      auto options = with_memory(memory);
      options.batches = batches;
      const double made = perf::median_seconds_of(
          runs, [&] { for_each_segment(WorkerSpace(), mesh, discrete_gradient_relations, ReadNothing(), options); });
      std::array<Id, 4> counts{};
      const double found = perf::median_seconds_of(
          runs, [&] { counts = find_discrete_gradient(WorkerSpace(), order, options).critical().counts(); });
      std::printf("gradient, %5zu MiB, %d batches: rows made %7.2f ms, all %7.2f ms: %d %d %d %d\n", memory / mebi,
                  batches, 1e3 * made, 1e3 * found, counts[0], counts[1], counts[2], counts[3]);
      std::fflush(stdout);
    }
  }
}

void measure_critical_points(const Mesh& mesh, const VertexOrder& order) {
  for (const std::size_t memory : {std::size_t(0), 24 * mebi, 48 * mebi, 96 * mebi, 384 * mebi, 1536 * mebi}) {
    for (const int threads : {64, 96}) {
      auto options = with_memory(memory);
      const double made = perf::median_seconds_of(
          runs, [&] { for_each_segment(WorkerSpace(), mesh, critical_points_relations, ReadNothing(), options); });
      options.threads_per_team = threads;
      std::size_t count = 0;
      const double found = perf::median_seconds_of(
          runs, [&] { count = find_critical_points(WorkerSpace(), order, options).vertices.size(); });
      std::printf("critical points, %5zu MiB, teams of %3d: rows made %7.2f ms, all %7.2f ms: %zu\n", memory / mebi,
                  threads, 1e3 * made, 1e3 * found, count);
      std::fflush(stdout);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const Kokkos::ScopeGuard kokkos(argc, argv);
  const int n = argc > 1 ? std::atoi(argv[1]) : 64;
  auto data = io::make_grid(n);
  const Mesh mesh = perf::encode(data);
  const double bandwidth = memory_bandwidth();
  std::printf("%s, grid:%d, %d segments; memory %.0f GB/s\n", perf::context().c_str(), n, mesh.segments(),
              bandwidth / 1e9);
  measure_overhead();
  for (int i = 2; i < argc; ++i) {
    if (const auto relation = relation_named(argv[i])) measure(mesh, *relation, bandwidth);
  }
  if (argc > 2) return 0;
  measure_set_up(mesh);
  measure(mesh, Relation::VV, bandwidth);
  const auto field = std::get<std::vector<float>>(data.arrays.front().values);
  const VertexOrder order(mesh, field.data(), field.size());
  measure_critical_points(mesh, order);
  measure_gradient(mesh, order);
}
