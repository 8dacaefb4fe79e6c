// The discrete gradient: initialization and sweep, by formulation, structure and number of consumers; each time from a
// new mesh. Medians.
//   usage: discrete_gradient_times [INPUT [RUNS [STRUCTURE [FORMULATION [CONSUMERS...]]]]]
// INPUT: grid:N, or a raw mesh (see support/inputs.hpp). STRUCTURE: gale, inline, explicit (where there is
// Kokkos-Kernels) or all. FORMULATION: stars (from VV, VT and link), cells (from VE, VF and VT) or all.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <gale/base/error.hpp>
#include <gale/baselines/discrete_gradient_from_cells.hpp>
#include <gale/runtime/explicit/explicit_structure.hpp>
#include <gale/runtime/make_structure.hpp>

#include "support/initialized.hpp"
#include "support/inputs.hpp"

namespace {

using namespace gale;

struct Formulation {
  std::string name;
  RelationSet relations;
  DiscreteGradient (*find)(Structure&, const VertexOrder&, const SweepOptions&);
};

struct StructureKind {
  std::string name;
  std::function<std::unique_ptr<Structure>(const Mesh&, RelationSet)> make;
};

std::unique_ptr<Structure> make_runtime(const Mesh& mesh, RelationSet relations, Way production) {
  StructureOptions options;
  options.way = production;
  return make_structure(mesh, relations, options);
}

const std::vector<Formulation> formulations = {
    {"stars", discrete_gradient_relations, find_discrete_gradient},
    {"cells", discrete_gradient_from_cells_relations, find_discrete_gradient_from_cells}};

const std::vector<StructureKind> structures = {
    {"gale", [](const Mesh& mesh, RelationSet relations) { return make_runtime(mesh, relations, Way::gale); }},
    {"inline", [](const Mesh& mesh, RelationSet relations) { return make_runtime(mesh, relations, Way::inline_); }},
#if defined(GALE_ENABLE_KOKKOS_KERNELS)
    {"explicit",
     [](const Mesh& mesh, RelationSet relations) -> std::unique_ptr<Structure> {
       return std::make_unique<ExplicitStructure>(mesh, relations);
     }}
#endif
};

struct Times {
  double segment, encode, order, start, sweep;
  double waiting = 0, computing = 0;  ///< of all consumers together
  double total() const { return segment + encode + order + start + sweep; }
};

Times run(const io::Dataset& data, const Formulation& formulation, const StructureKind& kind, int consumers,
          CriticalSimplices& critical) {
  const perf::Initialized input(data);
  std::unique_ptr<Structure> structure;
  SweepOptions options;
  options.threads = consumers;
  Times times{input.segment, input.encode, input.rank, 0, 0};
  times.start = perf::seconds_of([&] { structure = kind.make(input.mesh(), formulation.relations); });
  times.sweep = perf::seconds_of([&] { critical = formulation.find(*structure, input.order(), options).critical(); });
  const ConsumerStatistics all = structure->statistics().all_consumers();
  times.waiting = all.waiting.total();
  times.computing = all.seconds_computing;
  return times;
}

void measure(const io::Dataset& data, const Formulation& formulation, const StructureKind& kind, int consumers,
             int runs) {
  std::vector<Times> all;
  CriticalSimplices critical;
  for (int i = 0; i < runs; ++i) all.push_back(run(data, formulation, kind, consumers, critical));
  std::sort(all.begin(), all.end(), [](const Times& a, const Times& b) { return a.total() < b.total(); });
  const Times& t = all[all.size() / 2];
  const double vertices = static_cast<double>(std::get<io::Dataset::Points<float>>(data.points).extent(0));
  const double spent = t.sweep * consumers;
  const auto counts = critical.counts();
  std::printf(
      "%-5s %-8s %3d consumers: %7.3f s = segment %.3f + encode %.3f + order %.3f + structure %.3f + sweep %.3f; "
      "%5.0f ns a vertex and consumer, %4.1f %% of it waiting, %4.1f %% computing relations; critical %d %d %d %d\n",
      formulation.name.c_str(), kind.name.c_str(), consumers, t.total(), t.segment, t.encode, t.order, t.start, t.sweep,
      1e9 * spent / vertices, 100 * t.waiting / spent, 100 * t.computing / spent, counts[0], counts[1], counts[2],
      counts[3]);
  std::fflush(stdout);
}

bool is_wanted(const std::string& name, const std::string& wanted) { return wanted == "all" || wanted == name; }

}  // namespace

int main(int argc, char** argv) try {
  const Kokkos::ScopeGuard kokkos(argc, argv);
  const std::string input = argc > 1 ? argv[1] : "grid:64";
  const int runs = argc > 2 ? std::max(std::atoi(argv[2]), 1) : 3;
  const std::string structure = argc > 3 ? argv[3] : "all", formulation = argc > 4 ? argv[4] : "all";
  std::vector<int> consumers;
  for (int i = 5; i < argc; ++i) consumers.push_back(std::atoi(argv[i]));
  for (int count = 1; argc <= 5 && count <= host_threads(); count *= 2) consumers.push_back(count);
  const auto data = perf::make_input(input);
  std::printf("%s, %s\n", perf::context().c_str(), input.c_str());
  for (const auto& one : formulations) {
    for (const auto& kind : structures) {
      if (!is_wanted(one.name, formulation) || !is_wanted(kind.name, structure)) continue;
      for (const int count : consumers) measure(data, one, kind, count, runs);
    }
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "discrete_gradient_times: %s\n", error.what());
  return 1;
}
