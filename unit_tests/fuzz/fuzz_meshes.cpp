// Random meshes: all relations, critical points, gradient and Morse-Smale complex, by every structure, on several
// threads, and rows that several threads ask for in any order, compared with brute force.
//   fuzz_meshes [--count N] [--from I]
#include <atomic>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <thread>

#include <Kokkos_Core.hpp>

#include <gale/algorithms/critical_points.hpp>

#include "algorithms/brute_force_complex.hpp"
#include "algorithms/brute_force_types.hpp"
#include "algorithms/gradient_reader.hpp"
#include "algorithms/named_complex.hpp"
#include "algorithms/structure_kinds.hpp"
#include "fuzz/random_mesh.hpp"
#include "support/brute_force.hpp"
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

/// One mesh, with one field, on one structure.
Complaint check(std::uint64_t number) {
  Random random(number * 0xD1342543DE82EF95ull + 2);
  const InputMesh input = fuzz::random_mesh(random);
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
