// From arrays in device memory to results: the mesh, the order and what is found of grid:N, each after the other, and
// the gradient's arrays read on the host afterwards. Medians of five runs after one that isn't counted.
//   usage: from_device_arrays [N]

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <variant>
#include <vector>

#include <gale/algorithms/critical_points.hpp>
#include <gale/algorithms/morse_smale.hpp>
#include <gale/io/synthetic.hpp>
#include <gale/mesh/make_mesh.hpp>
#include <gale/runtime/make_structure.hpp>

#include "support/clock.hpp"

namespace {

using namespace gale;

constexpr int runs = 5;

/// Seconds of the steps of a run.
struct Steps {
  double mesh, order, points, gradient, successors, edges, complex;
};

double median(std::vector<Steps>& all, double Steps::*step) {
  std::sort(all.begin(), all.end(), [step](const Steps& a, const Steps& b) { return a.*step < b.*step; });
  return 1e3 * all[all.size() / 2].*step;
}

template <class Points, class Tetrahedra, class Field>
Steps run(const Points& points, const Tetrahedra& tetrahedra, const Field& field) {
  Steps took{};
  std::unique_ptr<Mesh> mesh;
  std::unique_ptr<VertexOrder> order;
  std::unique_ptr<DiscreteGradient> gradient;
  std::size_t found = 0;
  took.mesh = perf::seconds_of([&] { mesh = std::make_unique<Mesh>(make_mesh(points, tetrahedra)); });
  took.order = perf::seconds_of([&] { order = std::make_unique<VertexOrder>(*mesh, field); });
  took.points = perf::seconds_of([&] { found = find_critical_points(WorkerSpace(), *order).vertices.size(); });
  took.gradient = perf::seconds_of(
      [&] { gradient = std::make_unique<DiscreteGradient>(find_discrete_gradient(WorkerSpace(), *order)); });
  const auto structure = make_structure(*mesh, morse_smale_relations);
  took.complex = perf::seconds_of([&] { found += find_morse_smale_complex(*structure, *gradient).connectors.count(); });
  took.successors = perf::seconds_of(
      [&] { found += gradient->vertex_successors().extent(0) + gradient->cell_successors().extent(0); });
  took.edges = perf::seconds_of([&] { gradient->for_each_edge_pair(0, [&](Id, Id) { ++found; }); });
  if (found == 0) std::printf("nothing was found\n");
  return took;
}

}  // namespace

int main(int argc, char** argv) {
  const Kokkos::ScopeGuard kokkos(argc, argv);
  const int n = argc > 1 ? std::atoi(argv[1]) : 64;
  const auto data = io::make_grid(n);
  const auto& values = std::get<std::vector<float>>(data.arrays.front().values);
  const WorkerMemory memory;
  const auto points = Kokkos::create_mirror_view_and_copy(memory, std::get<io::Dataset::Points<float>>(data.points));
  const auto tetrahedra = Kokkos::create_mirror_view_and_copy(memory, data.tetrahedra);
  const auto field = Kokkos::create_mirror_view_and_copy(
      memory, Kokkos::View<const float*, HostMemory, Kokkos::MemoryUnmanaged>(values.data(), values.size()));
  std::vector<Steps> all;
  for (int i = 0; i < runs + 1; ++i) {
    const Steps took = run(points, tetrahedra, field);
    if (i > 0) all.push_back(took);
  }
  std::printf("%s, grid:%d\n", perf::context().c_str(), n);
  std::printf("mesh %.1f, order %.1f, critical points %.1f, gradient %.1f, complex %.1f ms\n",
              median(all, &Steps::mesh), median(all, &Steps::order), median(all, &Steps::points),
              median(all, &Steps::gradient), median(all, &Steps::complex));
  std::printf("the gradient's successors to the host %.1f ms, its edges %.1f ms\n", median(all, &Steps::successors),
              median(all, &Steps::edges));
}
