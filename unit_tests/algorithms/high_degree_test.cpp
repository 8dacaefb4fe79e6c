#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include <gale/algorithms/critical_points.hpp>
#include <gale/algorithms/gradient/pair_star.hpp>
#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/simplex_numbers.hpp>
#include <gale/algorithms/surface_vertices.hpp>
#include <gale/baselines/queued_lower_star.hpp>
#include <gale/runtime/make_structure.hpp>

#include "algorithms/brute_force_complex.hpp"
#include "algorithms/complexes.hpp"
#include "support/segmentations.hpp"

// Vertices and edges of very many tetrahedra. Whatever takes time quadratic in their number takes minutes here.

namespace gale::test {

namespace {

/// `count` tetrahedra around the edge (0, 1), the last beside the first. The other vertices are a circle.
InputMesh fan(Id count) {
  InputMesh mesh;
  mesh.points = {{0, 0, -1}, {0, 0, 1}};
  for (Id i = 0; i < count; ++i) {
    const double angle = 2 * 3.14159265358979 * i / count;
    mesh.points.push_back({std::cos(angle), std::sin(angle), 0});
    mesh.tetrahedra.push_back({2 + i, 0, 2 + (i + 1) % count, 1});
  }
  return mesh;
}

/// A vertex (0) whose link is a torus of `side` times `side` vertices, each with six neighbours.
InputMesh cone_over_torus(Id side) {
  InputMesh mesh;
  mesh.points.push_back({0, 0, -1});
  for (Id y = 0; y < side; ++y) {
    for (Id x = 0; x < side; ++x) {
      const Id right = (x + 1) % side, up = (y + 1) % side * side;
      mesh.points.push_back({double(x) / side, double(y) / side, 0});
      const Id a = 1 + y * side + x, b = 1 + y * side + right, c = 1 + up + x, d = 1 + up + right;
      mesh.tetrahedra.push_back({a, b, 0, d});
      mesh.tetrahedra.push_back({a, 0, c, d});
    }
  }
  return mesh;
}

/// A wave with few extrema, so that few walls cross the same cells; the first `hubs` vertices are below all others or
/// above them.
std::vector<double> wave_with_hubs(const InputMesh& mesh, Id hubs, bool are_above) {
  std::vector<double> field;
  for (Id v = 0; v < mesh.vertices(); ++v) {
    const auto& [x, y, z] = mesh.points[v];
    field.push_back(v < hubs ? (are_above ? 10 + v : -10 - v) : std::sin(4 * x) + std::cos(3 * y));
  }
  return field;
}

/// All that is found of a field, within a time that anything quadratic takes many times of.
void expect_fast(const InputMesh& input, const std::vector<double>& field) {
  const auto begin = std::chrono::steady_clock::now();
  const Mesh mesh = encode(input, 100);
  const VertexOrder order(mesh, field.data(), field.size());
  const auto runtime = make_structure(mesh, morse_smale_relations);
  EXPECT_FALSE(find_critical_points(*runtime, order).vertices.empty());
  MorseSmaleParts parts;
  parts.separatrices2 = true;
  const auto complex = find_morse_smale_complex(*runtime, find_discrete_gradient(*runtime, order), parts);
  EXPECT_EQ(complex.critical.euler(), 1) << "a mesh that contracts to a point";
  EXPECT_EQ(complex.ascending_walls.walls.sources.size(), complex.critical.edges.size());
  EXPECT_EQ(complex.descending_walls.sources.size(), complex.critical.triangles.size());
  const auto numbers = number_simplices(*runtime, {complex.critical.edges, complex.critical.triangles});
  EXPECT_EQ(std::set<Id>(numbers.edges.begin(), numbers.edges.end()).size(), complex.critical.edges.size());
  const auto on_surface = surface_vertices(mesh);
  for (Id v = 0; v < mesh.vertices(); ++v) ASSERT_EQ(on_surface(v), numbers.on_surface(v));
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 60);
}

void expect_that_of_brute_force(const InputMesh& input, const std::vector<double>& field) {
  const NamedComplex expected = brute_force_complex(input, BruteForceGradient(input, field));
  EXPECT_TRUE(equal(as_defined(ComplexOf(input, field).all()), expected));
}

}  // namespace

TEST(HighDegree, of_an_edge_is_fast) {
  const InputMesh input = fan(200000);
  expect_fast(input, wave_with_hubs(input, 2, true));
}

TEST(HighDegree, of_a_vertex_is_fast) {
  const InputMesh input = cone_over_torus(450);
  expect_fast(input, wave_with_hubs(input, 1, true));
}

TEST(HighDegree, gives_the_complex_of_brute_force) {
  for (const Id side : {8, 16}) {
    for (const auto& [input, hubs] : {std::make_pair(fan(side * side), 2), std::make_pair(cone_over_torus(side), 1)}) {
      for (const bool are_above : {false, true}) {
        SCOPED_TRACE(testing::Message() << hubs << " hubs, degree " << side * side << (are_above ? ", above" : ""));
        auto field = wave_with_hubs(input, hubs, are_above);
        expect_that_of_brute_force(input, field);
        const auto random = random_field(input, 7);
        std::copy(random.begin() + hubs, random.end(), field.begin() + hubs);
        for (Id v = 0; v < hubs; ++v) field[v] *= input.vertices();
        expect_that_of_brute_force(input, field);
        expect_that_of_brute_force(input, random);
      }
    }
  }
}

/// The star of the vertex of `cone_over_torus`, as if all others were lower. The link's Euler characteristic is 0, and
/// the edge that is paired with the vertex is left out.
TEST(HighDegree, of_a_vertex_is_fast_from_cells) {
  const Id side = 450, count = side * side;
  std::vector<Id> rank(count);
  std::iota(rank.begin(), rank.end(), 0);
  std::shuffle(rank.begin(), rank.end(), std::mt19937(3));
  const auto rank_of = [&](Id x, Id y) { return rank[y % side * side + x % side]; };
  const auto begin = std::chrono::steady_clock::now();
  detail::QueuedLowerStar star;
  star.begin(count, 3 * count, 2 * count);
  for (Id i = 0; i < count; ++i) {
    const Id x = i % side, y = i / side;
    for (const auto& [dx, dy] : {std::make_pair(1, 0), std::make_pair(0, 1), std::make_pair(1, 1)}) {
      star.add_triangle(rank_of(x, y), rank_of(x + dx, y + dy));
    }
  }
  star.end_triangles();
  for (Id i = 0; i < count; ++i) {
    const Id x = i % side, y = i / side;
    for (const Id between : {rank_of(x + 1, y), rank_of(x, y + 1)}) {
      std::array<Id, 3> corners = {rank_of(x, y), between, rank_of(x + 1, y + 1)};
      std::sort(corners.begin(), corners.end(), std::greater<Id>());
      star.add_tetrahedron(corners[0], corners[1], corners[2], i);
    }
  }
  star.end();
  Id pairs = 0;
  std::array<Id, 4> critical{};
  detail::pair_cells(
      star, [&](int, int) { ++pairs; }, [&](int cell) { ++critical[star.dimension(cell)]; });
  EXPECT_EQ(2 * pairs + critical[1] + critical[2] + critical[3], 6 * count - 1);
  EXPECT_EQ(critical[2] - critical[1] - critical[3], 1);
  EXPECT_GE(critical[2], 2) << "a torus has two independent loops";
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 60);
}

}  // namespace gale::test
