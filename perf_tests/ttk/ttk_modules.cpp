// TTK's base modules on TTK's explicit triangulation and on GALE's: are the results equal, and what does each take?
//
//     ttk_modules INPUT MODULE explicit|gale|both [THREADS [MEMORY_IN_MIB [WAY]]]
//
// INPUT is `grid:N`, `plane:N` or the like, a raw mesh (support/inputs.hpp), or, where unit tests are built,
// `test:NAME`, one of their meshes or surfaces; MODULE one of critical-points, discrete-gradient, morse-smale,
// morse-smale-walls, persistence, contour-tree, smoother, jacobi-set and path-compression, or all of them. A line each
// of what it took, peak memory of the process included, and of processors and peaks by setup, preconditioning and run;
// `both` also says whether all arrays are equal, element by element, and exits with 1 if not. MEMORY_IN_MIB bounds
// GALE's translated blocks (0: as many as by default), WAY is how GALE computes rows: gale, leaders, helpers or inline.

#include <ExplicitTriangulation.h>
#include <omp.h>

#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <tuple>

#include <gale/ttk/triangulation.hpp>

#include "modules.hpp"
#include "support/inputs.hpp"
#ifdef GALE_TEST_MESHES
#include "support/input_mesh.hpp"
#include "support/surfaces.hpp"
#endif

namespace {

using gale::perf::Fields;
using gale::perf::ModuleResult;

/// What TTK is given of a mesh.
struct CallersMesh {
  std::vector<float> points;
  std::vector<::ttk::LongSimplexId> cells;
  int count = 0;  ///< of cells
  Fields fields;
};

#ifdef GALE_TEST_MESHES
/// A mesh with a field that has many equal values.
template <int corners>
gale::io::Dataset with_field(const std::vector<std::array<double, 3>>& from,
                             const std::vector<std::array<gale::Id, corners>>& cells) {
  gale::io::Dataset data;
  const gale::io::Dataset::Points<float> points("points", from.size());
  std::vector<float> field;
  for (std::size_t v = 0; v < from.size(); ++v) {
    for (int axis = 0; axis < 3; ++axis) points(v, axis) = static_cast<float>(from[v][axis]);
    field.push_back(static_cast<float>(v * 7919 % 31));
  }
  data.points = points;
  const Kokkos::View<std::int32_t* [corners], Kokkos::LayoutRight, Kokkos::HostSpace> copy("cells", cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    for (int corner = 0; corner < corners; ++corner) copy(c, corner) = cells[c][corner];
  }
  if constexpr (corners == 4) {
    data.tetrahedra = copy;
  } else {
    data.triangles = copy;
  }
  data.arrays.push_back({"field", 1, std::move(field)});
  return data;
}
#endif

/// A mesh that unit tests loop over.
gale::io::Dataset test_mesh(const std::string& name) {
#ifdef GALE_TEST_MESHES
  const auto& names = gale::test::mesh_names();
  const auto& surfaces = gale::test::surfaces();
  if (std::find(names.begin(), names.end(), name) != names.end()) {
    const gale::test::InputMesh& mesh = gale::test::mesh_named(name);
    return with_field<4>(mesh.points, mesh.tetrahedra);
  }
  if (surfaces.count(name) != 0) return with_field<3>(surfaces.at(name).points, surfaces.at(name).triangles);
  std::string there;
  for (const std::string& one : names) there += " test:" + one;
  for (const auto& [one, surface] : surfaces) there += " 'test:" + one + "'";
  throw gale::Error("there is no mesh 'test:" + name + "', but" + there);
#else
  throw gale::Error("'test:" + name + "' needs a build with GALE_ENABLE_TESTS");
#endif
}

CallersMesh callers_mesh(const std::string& input, int threads) {
  const gale::io::Dataset data =
      input.rfind("test:", 0) == 0 ? test_mesh(input.substr(5)) : gale::perf::make_input(input);
  const auto& points = std::get<gale::io::Dataset::Points<float>>(data.points);
  CallersMesh mesh;
  mesh.points.assign(points.data(), points.data() + points.size());
  mesh.count = static_cast<int>(data.cells());
  mesh.cells.reserve((data.dimension() + 2) * data.cells());
  const auto add = [&](const auto& cells) {
    for (std::size_t c = 0; c < cells.extent(0); ++c) {
      mesh.cells.push_back(cells.extent(1));
      for (std::size_t corner = 0; corner < cells.extent(1); ++corner) mesh.cells.push_back(cells(c, corner));
    }
  };
  add(data.tetrahedra);
  add(data.triangles);
  auto& values = mesh.fields.values;
  values = std::get<std::vector<float>>(data.arrays[0].values);
  std::vector<::ttk::SimplexId> sorted(values.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) sorted[i] = static_cast<::ttk::SimplexId>(i);
  std::sort(sorted.begin(), sorted.end(),
            [&](auto a, auto b) { return values[a] != values[b] ? values[a] < values[b] : a < b; });
  mesh.fields.order.resize(sorted.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) mesh.fields.order[sorted[i]] = static_cast<::ttk::SimplexId>(i);
  mesh.fields.threads = threads;
  return mesh;
}

template <class Triangulation>
ModuleResult run(const char* kind, const std::string& module, const CallersMesh& mesh, Triangulation& triangulation) {
  triangulation.setDebugLevel(0);
  triangulation.setThreadNumber(mesh.fields.threads);
  gale::perf::Took setup;
  setup.time([&] {
    triangulation.setInputPoints(static_cast<int>(mesh.points.size() / 3), mesh.points.data());
    triangulation.setInputCells(mesh.count, mesh.cells.data());
  });
  const auto result = gale::perf::run_module(module, mesh.fields, triangulation);
  const auto& [precondition, run] = std::tie(result.precondition, result.run);
  std::printf(
      "%-18s %-9s threads %d: setup %.3f precondition %.3f run %.3f total %.3f s, of processors %.3f s; peak %.0f MB "
      "(%.3f + %.3f + %.3f s; %.0f, %.0f, %.0f MB)\n",
      module.c_str(), kind, mesh.fields.threads, setup.seconds, precondition.seconds, run.seconds,
      setup.seconds + precondition.seconds + run.seconds, setup.processors + precondition.processors + run.processors,
      run.peak, setup.processors, precondition.processors, run.processors, setup.peak, precondition.peak, run.peak);
  return result;
}

/// Positions of degenerate cells may be no numbers.
bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/// Says where two results differ.
bool equal(const ModuleResult& a, const ModuleResult& b) {
  bool all = a.arrays.size() == b.arrays.size() && !a.arrays.empty();
  std::size_t numbers = 0;
  for (std::size_t i = 0; all && i < a.arrays.size(); ++i) {
    const auto& [name, values] = a.arrays[i];
    const auto& others = b.arrays[i].second;
    numbers += values.size();
    if (std::equal(values.begin(), values.end(), others.begin(), others.end(), same)) continue;
    all = false;
    std::printf("  %s differ: %zu and %zu numbers", name.c_str(), values.size(), others.size());
    for (std::size_t k = 0; k < std::min(values.size(), others.size()); ++k) {
      if (same(values[k], others[k])) continue;
      std::printf("; at %zu %g and %g", k, values[k], others[k]);
      break;
    }
    std::printf("\n");
  }
  if (all) std::printf("  equal: %zu numbers in %zu arrays\n", numbers, a.arrays.size());
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> all = {"contour-tree",     "critical-points", "discrete-gradient",
                                        "jacobi-set",       "morse-smale",     "morse-smale-walls",
                                        "path-compression", "persistence",     "smoother"};
  const std::string kind = argc > 3 ? argv[3] : "";
  if (kind != "explicit" && kind != "gale" && kind != "both") {
    std::fprintf(stderr, "usage: %s INPUT MODULE|all explicit|gale|both [THREADS [MEMORY_IN_MIB [WAY]]]\n", argv[0]);
    return 2;
  }
  const std::string module = argv[2];
  if (module != "all" && std::find(all.begin(), all.end(), module) == all.end()) {
    std::fprintf(stderr, "%s: there is no module '%s'\n", argv[0], argv[2]);
    return 2;
  }
  const int threads = argc > 4 ? std::atoi(argv[4]) : omp_get_max_threads();
  omp_set_num_threads(threads);
  ::ttk::globalDebugLevel_ = 0;
  const Kokkos::ScopeGuard kokkos(gale::initialization_arguments(threads));
  bool as_told = true;
  try {
    const CallersMesh mesh = callers_mesh(argv[1], threads);
    gale::ttk::Options options;
    if (argc > 5) options.memory = std::size_t(std::atol(argv[5])) << 20;
    if (argc > 6) {
      const auto way = gale::way_named(argv[6]);
      if (!way) throw gale::Error(std::string("there is no way '") + argv[6] + "'");
      options.structure.way = *way;
    }
    for (const std::string& name : module == "all" ? all : std::vector<std::string>{module}) {
      std::optional<ModuleResult> results[2];
      if (kind != "gale") {
        ::ttk::ExplicitTriangulation triangulation;
        results[0] = run("explicit", name, mesh, triangulation);
      }
      if (kind != "explicit") {
        gale::ttk::Triangulation triangulation(options);
        results[1] = run("gale", name, mesh, triangulation);
      }
      if (kind == "both") as_told = equal(*results[0], *results[1]) && as_told;
    }
  } catch (const gale::Error& error) {
    std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
    return 1;
  }
  return as_told ? 0 : 1;
}
