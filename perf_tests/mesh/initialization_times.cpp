// What is done once for a mesh, step by step: octree, encoding, enumeration, mirrors on the host; and every kernel and
// copy below that.
//   usage: initialization_times [N [RUNS]]

#include <cstdio>
#include <cstdlib>

#include <gale/relations/preconditioning.hpp>

#include "support/bench_mesh.hpp"
#include "support/clock.hpp"
#include "support/kernel_times.hpp"

namespace {

using namespace gale;

/// What the discrete gradient in the paper's formulation reads: its consumers look up the first, workers compute the
/// second.
constexpr RelationSet looked_up =
    Relation::EV | Relation::FV | Relation::FE | Relation::TV | Relation::TE | Relation::TF;
constexpr RelationSet computed = Relation::VE | Relation::VF | Relation::VT;

/// Prints what a step took, and gives it back.
template <class Action>
double step(const char* name, const Action& action) {
  const double seconds = perf::seconds_of(action);
  std::printf("  %-34s %8.1f ms\n", name, 1e3 * seconds);
  return seconds;
}

void initialize(const io::Dataset& data) {
  const auto& points = std::get<io::Dataset::Points<float>>(data.points);
  Segmentation segmentation;
  const double octree =
      step("octree", [&] { segmentation = octree_segmentation<float, HostMemory>(Points<float, HostMemory>(points)); });
  std::unique_ptr<Mesh> mesh;
  const double encoding = step("encoding (VV and VT need no more)", [&] {
    mesh = std::make_unique<Mesh>(Tetrahedra<Id, HostMemory>(data.tetrahedra), segmentation);
  });
  double enumeration = step("edges and triangles", [&] { mesh->simplices<WorkerMemory>(needs_of(looked_up)); });
  enumeration += step("edges by their higher vertex", [&] { mesh->simplices<WorkerMemory>(needs_of(computed)); });
  const double mirror = step("mirrors on the host", [&] { mesh->simplices(needs_of(looked_up)); });
  std::printf("  for VV and VT %.1f ms, octree included; for the gradient %.1f ms, segmentation given\n",
              1e3 * (octree + encoding), 1e3 * (encoding + enumeration + mirror));
  const double edges = mesh->known_edges(), triangles = mesh->known_triangles();
  std::printf("  %.1f M edges, %.1f M triangles; on the host %.2f GB for edges, %.2f GB for triangles\n", edges / 1e6,
              triangles / 1e6, (12 * edges + 4.0 * mesh->vertices()) / 1e9, 8 * triangles / 1e9);
}

}  // namespace

int main(int argc, char** argv) {
  const Kokkos::ScopeGuard kokkos(argc, argv);
  const int n = argc > 1 ? std::atoi(argv[1]) : 64;
  const int runs = argc > 2 ? std::atoi(argv[2]) : 3;
  const io::Dataset data = io::make_grid(n);
  std::printf("%s, grid:%d\n", perf::context().c_str(), n);
  for (int run = 0; run < runs; ++run) {
    std::printf("run %d\n", run);
    initialize(data);
  }
  const perf::KernelTimes times;
  initialize(data);
  times.print();
}
