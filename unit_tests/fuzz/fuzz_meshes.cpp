// Random meshes, of tetrahedra or of cells that are split into them: all relations, critical points, gradient and
// Morse-Smale complex, by every structure, on several threads, and rows that several threads ask for in any order,
// compared with brute force.
//   fuzz_meshes [--count N] [--from I]
#include <atomic>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <thread>

#include <Kokkos_Core.hpp>

#include <gale/algorithms/critical_points.hpp>
#include <gale/base/error.hpp>
#include <gale/mesh/make_mesh.hpp>

#include "algorithms/brute_force_complex.hpp"
#include "algorithms/brute_force_types.hpp"
#include "algorithms/gradient_reader.hpp"
#include "algorithms/named_complex.hpp"
#include "algorithms/structure_kinds.hpp"
#include "fuzz/random_mesh.hpp"
#include "support/brute_force.hpp"
#include "support/mixed_cells.hpp"
#include "support/segmentations.hpp"

namespace {

using namespace gale;
using namespace gale::test;
using fuzz::Random;

/// Says what is wrong; empty if nothing is.
using Complaint = std::string;

Complaint complaint_of(const testing::AssertionResult& result, const std::string& about) {
  return result ? "" : about + ": " + result.message();
}

Segmentation random_segmentation(const InputMesh& input, Random& random) {
  if (random.one_in(2)) return octree_of(input, static_cast<int>(1 + random.below(20)));
  std::vector<std::int64_t> labels(input.points.size());
  for (auto& label : labels) label = static_cast<std::int64_t>(random.below(1 + random.below(9)));
  return segmentation_by(labels);
}

/// Several threads ask one structure for rows, each in an order of its own.
Complaint check_rows(const BruteForce& simplices, const ExpectedRows& expected, Structure& structure, Random& random) {
  constexpr int threads = 3;
  std::atomic<int> wrong{0};
  std::vector<std::thread> all;
  for (int i = 0; i < threads; ++i) {
    all.emplace_back([&, seed = random.next()] {
      Random choice(seed);
      const auto consumer = structure.consumer();
      const auto relations = members_of(all_relations);
      for (int request = 0; request < 200; ++request) {
        const Relation relation = relations[choice.below(relations.size())];
        const std::size_t rows = simplices.simplices(row_dimension(relation)).size();
        if (rows == 0) continue;
        const auto simplex = static_cast<Id>(choice.below(rows));
        if (!expected.match(relation, simplex, consumer->row(relation, simplex))) ++wrong;
      }
    });
  }
  for (std::thread& thread : all) thread.join();
  return wrong == 0 ? "" : std::to_string(wrong) + " rows differ";
}

Complaint check_critical_points(const CriticalPoints& points, const std::vector<int>& types) {
  constexpr int regular = 5;
  std::size_t at = 0;
  for (std::size_t v = 0; v < types.size(); ++v) {
    if (types[v] == regular) continue;
    if (at >= points.vertices.size() || points.vertices[at] != static_cast<Id>(v) ||
        static_cast<int>(points.types[at]) != types[v]) {
      return "critical points differ at vertex " + std::to_string(v);
    }
    ++at;
  }
  return at == points.vertices.size() ? "" : "too many critical points";
}

SplitCells<4, HostMemory> split(const MixedMesh& mesh, const std::vector<std::int64_t>& connectivity,
                                const std::vector<std::int64_t>& offsets, const std::vector<std::uint8_t>& types) {
  const auto view = [](const auto& values) {
    using Value = typename std::decay_t<decltype(values)>::value_type;
    return Array<const Value, HostMemory>(values.data(), values.size());
  };
  const Cells<std::int64_t, HostMemory> cells{view(types), view(offsets), view(connectivity)};
  return split_cells(cells, static_cast<Offset>(mesh.points.size()));
}

MixedMesh random_cells(Random& random) {
  const auto seed = static_cast<std::uint32_t>(random.next());
  if (random.one_in(4)) return collapsed_cylinder(3 + static_cast<int>(random.below(3)), 1, 1, seed);
  return mixed_mesh(1 + static_cast<int>(random.below(2)), 1 + static_cast<int>(random.below(2)), seed);
}

/// The tetrahedra of cells that fit.
InputMesh tetrahedra_of_cells(Random& random) {
  const MixedMesh mesh = random_cells(random);
  const auto found = split(mesh, mesh.connectivity(), mesh.offsets(), mesh.types()).simplices;
  InputMesh input{mesh.points, {}};
  for (std::size_t t = 0; t < found.extent(0); ++t)
    input.tetrahedra.push_back({found(t, 0), found(t, 1), found(t, 2), found(t, 3)});
  return input;
}

/// Cells some of which are wrong: they are refused in one line, or are tetrahedra of four points each.
Complaint check_wrong_cells(Random& random) {
  const MixedMesh mesh = random_cells(random);
  auto connectivity = mesh.connectivity(), offsets = mesh.offsets();
  auto types = mesh.types();
  for (std::uint64_t count = 1 + random.below(3); count > 0; --count) {
    constexpr std::int64_t far = std::int64_t(1) << 40;
    const std::int64_t values[] = {-far, -1, 0, 1, 2, 3, 4, 5, 8, 100, far};
    const std::int64_t value = values[random.below(11)];
    switch (random.below(4)) {
      case 0:
        types[random.below(types.size())] = static_cast<std::uint8_t>(random.below(random.one_in(2) ? 45 : 256));
        break;
      case 1:
        offsets[random.below(offsets.size())] += value;
        break;
      case 2:
        connectivity[random.below(connectivity.size())] = value;
        break;
      default:
        connectivity.resize(random.below(connectivity.size() + 1));
    }
  }
  try {
    const auto found = split(mesh, connectivity, offsets, types);
    for (std::size_t t = 0; t < found.simplices.extent(0); ++t) {
      for (int k = 0; k < 4; ++k) {
        const Id v = found.simplices(t, k);
        if (v < 0 || v >= static_cast<Id>(mesh.points.size())) return "a tetrahedron has no such point";
      }
      if (found.cells.extent(0) > 0 && found.cells(t) >= static_cast<Id>(types.size())) return "there is no such cell";
    }
    Mesh(Tetrahedra<Id, HostMemory>(found.simplices), octree_of({mesh.points, {}}, 20));
  } catch (const Error& error) {
    const std::string line = error.what();
    if (line.empty() || line.find('\n') != std::string::npos) return "not one line: '" + line + "'";
  }
  return "";
}

/// One mesh, with one field, on one structure.
Complaint check(std::uint64_t number) {
  Random random(number * 0xD1342543DE82EF95ull + 2);
  const Complaint wrong_cells = check_wrong_cells(random);
  if (!wrong_cells.empty()) return wrong_cells;
  const InputMesh input = random.one_in(5) ? tetrahedra_of_cells(random) : fuzz::random_mesh(random);
  const Mesh mesh = encode(input, random_segmentation(input, random));
  const BruteForce simplices(input);
  const ExpectedRows expected(input, simplices, mesh, all_relations);
  const auto kinds = structure_kinds();
  const auto& kind = kinds[number % kinds.size()];
  const auto structure = kind.make(mesh, all_relations | morse_smale_relations | critical_points_relations);
  Complaint wrong = check_rows(simplices, expected, *structure, random);
  const std::string on = " on " + kind.name;
  if (!wrong.empty()) return wrong + on;

  const std::vector<double> field = fuzz::random_field(input.points.size(), random);
  const VertexOrder order(mesh, field.data(), field.size());
  const SweepOptions sweep = with_threads(static_cast<int>(1 + random.below(3)));
  wrong =
      check_critical_points(find_critical_points(*structure, order, sweep), brute_force_types(input, simplices, field));
  if (!wrong.empty()) return wrong + on;
  const BruteForceGradient right(input, field);
  const DiscreteGradient gradient = find_discrete_gradient(*structure, order, sweep);
  wrong = complaint_of(GradientReader(simplices, mesh).match(gradient, pairs_of(right, simplices)), "gradient");
  if (!wrong.empty()) return wrong + on;
  MorseSmaleParts parts;
  parts.separatrices2 = true;
  const NamedComplex found = named(find_morse_smale_complex(*structure, gradient, parts, sweep));
  return complaint_of(equal(as_defined(found), brute_force_complex(input, right)), "complex" + on);
}

}  // namespace

int main(int argc, char** argv) {
  std::uint64_t count = 300, from = 0;
  for (int i = 1; i + 1 < argc; i += 2) {
    (std::string(argv[i]) == "--from" ? from : count) = std::strtoull(argv[i + 1], nullptr, 10);
  }
  const Kokkos::ScopeGuard kokkos(argc, argv);
  int finds = 0;
  for (std::uint64_t number = from; number < from + count; ++number) {
    Complaint wrong;
    try {
      wrong = check(number);
    } catch (const std::exception& error) {
      wrong = error.what();
    }
    if (wrong.empty()) continue;
    ++finds;
    std::cout << "mesh " << number << ": " << wrong << std::endl;
  }
  std::cout << count << " meshes tried from number " << from << ", " << finds << " finds\n";
  return finds == 0 ? 0 : 1;
}
