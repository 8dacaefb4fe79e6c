// What is done once for a mesh, step by step: octree, encoding, order, enumeration, mirrors on the host; beside each
// the bytes that it must read and write once, by the memory's bandwidth. And every kernel and copy below that.
//   usage: initialization_times [N or INPUT [RUNS]]

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include <gale/algorithms/vertex_order.hpp>
#include <gale/base/parallel.hpp>
#include <gale/relations/preconditioning.hpp>

#include "support/clock.hpp"
#include "support/inputs.hpp"
#include "support/kernel_times.hpp"

namespace {

using namespace gale;

/// What the discrete gradient in the paper's formulation reads: its consumers look up the first, workers compute the
/// second.
constexpr RelationSet looked_up =
    Relation::EV | Relation::FV | Relation::FE | Relation::TV | Relation::TE | Relation::TF;
constexpr RelationSet computed = Relation::VE | Relation::VF | Relation::VT;

/// Bytes per second that the workers read and write together, copying in their memory.
double memory_bandwidth() {
  using Words = Array<std::uint64_t, WorkerMemory>;
  constexpr Offset words = Offset(1) << 24;
  const Words from("GALE::bandwidth_from", words), to("GALE::bandwidth_to", words);
  const WorkerSpace space;
  const double seconds = perf::median_seconds_of(5, [&] {
    parallel_for(
        "GALE::bandwidth", space, words, KOKKOS_LAMBDA(Offset i) { to(i) = from(i); });
    space.fence();
  });
  return 16.0 * words / seconds;
}

/// Prints steps beside their bounds, and adds them up.
class Steps {
 public:
  explicit Steps(double bandwidth) : bandwidth_(bandwidth) {
    std::printf("%32s %9s %11s %9s %8s\n", "", "by clock", "processors", "faulted", "bound");
  }

  /// Runs a step. What it must read and write at least is known when it is done.
  template <class Action, class Bytes>
  void run(const char* name, const Action& action, const Bytes& bytes) {
    const double processors = perf::processor_seconds(), faulted = perf::bytes_faulted();
    Cost cost;
    cost.seconds = perf::seconds_of(action);
    cost.processors = perf::processor_seconds() - processors;
    cost.faulted = perf::bytes_faulted() - faulted;
    cost.bytes = bytes();
    print(name, cost);
    all_.seconds += cost.seconds;
    all_.processors += cost.processors;
    all_.faulted += cost.faulted;
    all_.bytes += cost.bytes;
  }

  void print_sum(const char* name) const { print(name, all_); }

 private:
  struct Cost {
    double seconds = 0, processors = 0, faulted = 0, bytes = 0;
  };

  void print(const char* name, const Cost& cost) const {
    std::printf("  %-30s %6.1f ms %8.1f ms %6.0f MB %5.1f ms (%.0f MB)\n", name, 1e3 * cost.seconds,
                1e3 * cost.processors, cost.faulted / 1e6, 1e3 * cost.bytes / bandwidth_, cost.bytes / 1e6);
  }

  double bandwidth_;
  Cost all_;
};

void initialize(const io::Dataset& data, double bandwidth) {
  const auto& points = std::get<io::Dataset::Points<float>>(data.points);
  const auto& field = std::get<std::vector<float>>(data.arrays[0].values);
  const double vertices = points.extent(0), tetrahedra = data.tetrahedra.extent(0);
  Steps steps(bandwidth);
  Segmentation segmentation;
  steps.run(
      "octree", [&] { segmentation = octree_segmentation<float, HostMemory>(Points<float, HostMemory>(points)); },
      [&] { return (12 + 4) * vertices; });
  std::unique_ptr<Mesh> mesh;
  steps.run(
      "encoding", [&] { mesh = std::make_unique<Mesh>(Tetrahedra<Id, HostMemory>(data.tetrahedra), segmentation); },
      [&] {
        const auto& begin = mesh->external_begin();
        return (4 + 4 + 4) * vertices + (16 + 16 + 4) * tetrahedra + 8.0 * begin.extent(0) +
               4.0 * begin(mesh->segments());
      });
  std::unique_ptr<VertexOrder> order;
  steps.run(
      "order of a field's values", [&] { order = std::make_unique<VertexOrder>(*mesh, field.data(), field.size()); },
      [&] { return (4 + 4 + 8) * vertices; });
  steps.print_sum("for critical points and gradient");
  steps.run(
      "edges and triangles", [&] { mesh->simplices<WorkerMemory>(needs_of(looked_up)); },
      [&] { return 16 * tetrahedra + 4 * vertices + 12.0 * mesh->known_edges() + 8.0 * mesh->known_triangles(); });
  steps.run(
      "edges by their higher vertex", [&] { mesh->simplices<WorkerMemory>(needs_of(computed)); },
      [&] { return 4 * vertices + 8.0 * mesh->known_edges(); });
  if (have_device) {
    steps.run(
        "mirrors on the host", [&] { mesh->simplices(needs_of(looked_up)); }, [&] { return 0.0; });
  }
  steps.print_sum("for the gradient in cells");
}

}  // namespace

int main(int argc, char** argv) {
  const Kokkos::ScopeGuard kokkos(argc, argv);
  const std::string input = argc > 1 ? argv[1] : "64";
  const int runs = argc > 2 ? std::atoi(argv[2]) : 3;
  const bool is_number = std::all_of(input.begin(), input.end(), [](unsigned char c) { return std::isdigit(c); });
  const io::Dataset data = perf::make_input(is_number ? "grid:" + input : input);
  const double bandwidth = memory_bandwidth();
  std::printf("%s, %s, memory %.1f GB/s there and back\n", perf::context().c_str(), input.c_str(), bandwidth / 1e9);
  for (int run = 0; run < runs; ++run) {
    std::printf("run %d\n", run);
    initialize(data, bandwidth);
  }
  const perf::KernelTimes times;
  initialize(data, bandwidth);
  times.print();
}
