// Critical points and gradient of a mesh on several ranks: the seconds of each step, by the slowest rank, and what was
// sent. On one rank also the same without MPI. Medians of steps.
//   usage: mpirun -n RANKS distributed_times [N [RUNS [as-given|curve]]]
// N: the grid, of which each rank makes a slab.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <gale/algorithms/critical_points.hpp>
#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/base/threads.hpp>
#include <gale/distributed/distributed_mesh.hpp>
#include <gale/runtime/make_structure.hpp>

#include "support/clock.hpp"
#include "support/initialized.hpp"

namespace {

using namespace gale;

/// Seconds by the name of the step, of each run.
using Times = std::map<std::string, std::vector<double>>;

/// Both sweeps, by consumers on the host or, where there is a device, by kernels.
void sweep(const Mesh& mesh, const VertexOrder& order, Times& times) {
  std::unique_ptr<Structure> structure;
  times["3 structure"].push_back(perf::seconds_of([&] {
    if (!have_device) structure = make_structure(mesh, discrete_gradient_relations);
  }));
  times["4 critical points"].push_back(perf::seconds_of(
      [&] { have_device ? find_critical_points(WorkerSpace(), order) : find_critical_points(*structure, order); }));
  times["5 gradient"].push_back(perf::seconds_of(
      [&] { have_device ? find_discrete_gradient(WorkerSpace(), order) : find_discrete_gradient(*structure, order); }));
}

template <class Index>
void run_on_ranks(const Communicator& ranks, const io::GridPartOf<Index>& part, bool repartition, Times& times) {
  const auto count = static_cast<Offset>(part.field.size());
  const auto ids = allocate<Array<GlobalId, HostMemory>>("ids", count);
  parallel_for("ids", HostExecutionSpace(), count, [&](Offset i) { ids(i) = part.first_vertex + i; });
  PartitionOptions options;
  options.repartition = repartition;
  std::optional<DistributedMesh> mesh;
  std::optional<VertexOrder> order;
  times["1 mesh"].push_back(
      perf::seconds_of([&] { mesh.emplace(ranks, make_part(ids, part.points, part.tetrahedra), options); }));
  times["2 order"].push_back(perf::seconds_of(
      [&] { order.emplace(*mesh, Kokkos::View<const float*, HostMemory>(part.field.data(), part.field.size())); }));
  sweep(*mesh, *order, times);
}

void run_without_mpi(const io::Dataset& data, Times& times) {
  const perf::Initialized input(data);
  times["1 mesh"].push_back(input.segment + input.encode);
  times["2 order"].push_back(input.rank);
  sweep(input.mesh(), input.order(), times);
}

/// The median of each step, of the slowest rank.
void print(const Communicator& ranks, const char* title, Times& times) {
  double total = 0;
  std::string line;
  for (auto& [step, all] : times) {
    std::sort(all.begin(), all.end());
    const double slowest = -ranks.least(-all[all.size() / 2]);
    total += slowest;
    line += ", " + step.substr(2) + ' ' + std::to_string(slowest);
  }
  if (ranks.rank() == 0) std::printf("%-12s %8.3f s%s\n", title, total, line.c_str());
}

void measure(int n, int runs, bool repartition) {
  const Communicator ranks(MPI_COMM_WORLD);
  set_host_threads(std::max(host_threads() / ranks.size(), 1));
  Times with, without;
  SentMessages before;
  {
    const auto run = [&](const auto& part) {
      for (int i = 0; i < runs; ++i) {
        before = ranks.sent();
        run_on_ranks(ranks, part, repartition, with);
      }
    };
    constexpr int most = 1290;  // whose vertices 32 bits number
    n <= most ? run(io::make_grid_part<std::int32_t>(n, ranks.rank(), ranks.size()))
              : run(io::make_grid_part(n, ranks.rank(), ranks.size()));
  }
  if (ranks.rank() == 0)
    std::printf("%s, grid:%d on %d ranks of %d threads\n", perf::context().c_str(), n, ranks.size(), host_threads());
  print(ranks, "with MPI", with);
  const double sent = -ranks.least(-static_cast<double>(ranks.sent().bytes - before.bytes));
  const double waited = -ranks.least(-(ranks.sent().seconds_waiting - before.seconds_waiting));
  if (ranks.rank() == 0) {
    std::printf("%-12s %8.1f MB sent by one rank at most, %.4f s waited by one at most\n", "", 1e-6 * sent, waited);
  }
  if (ranks.size() > 1) return;
  const io::Dataset data = io::make_grid(n);
  for (int i = 0; i < runs; ++i) run_without_mpi(data, without);
  print(ranks, "without MPI", without);
}

}  // namespace

int main(int argc, char** argv) {
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  try {
    const Kokkos::ScopeGuard kokkos(argc, argv);
    measure(argc > 1 ? std::atoi(argv[1]) : 64, argc > 2 ? std::max(std::atoi(argv[2]), 1) : 3,
            argc > 3 && std::string(argv[3]) == "curve");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "distributed_times: %s\n", error.what());
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  MPI_Finalize();
}
