#include <algorithm>
#include <atomic>
#include <thread>

#include <gtest/gtest.h>

#include <gale/base/threads.hpp>
#include <gale/mesh/grid.hpp>

#include "support/brute_force.hpp"
#include "support/segmentations.hpp"

namespace gale::test {

namespace {

Mesh holed() {
  const InputMesh& input = mesh_named("holed_grid_9");
  return encode(input, 7);
}

constexpr SimplexNeeds edges = {Enumeration::edges, false, false};
constexpr SimplexNeeds lower_edges = {Enumeration::edges, true, false};
constexpr SimplexNeeds triangles = {Enumeration::triangles, false, false};
constexpr SimplexNeeds tetrahedra = {Enumeration::cells, false, true};
constexpr SimplexNeeds everything = {Enumeration::triangles, true, true};

Id count_of(int dimension) { return static_cast<Id>(brute_force_of("holed_grid_9").simplices(dimension).size()); }

}  // namespace

TEST(Enumeration, waits_until_someone_needs_it) {
  const Mesh mesh = holed();
  mesh.encoded();
  mesh.simplices(tetrahedra);
  mesh.simplices<WorkerMemory>(tetrahedra);
  EXPECT_EQ(mesh.known_edges(), no_id);
  EXPECT_EQ(mesh.known_triangles(), no_id);
  EXPECT_EQ(mesh.intervals_of(0)[1].size(), 0);
  EXPECT_EQ(mesh.intervals_of(0)[2].size(), 0);
  EXPECT_GT(mesh.intervals_of(0)[3].size(), 0);
  EXPECT_EQ(mesh.known_edges(), no_id) << "intervals_of enumerates nothing";
}

TEST(Enumeration, of_edges_needs_no_triangles) {
  const Mesh mesh = holed();
  mesh.simplices<WorkerMemory>(edges);
  EXPECT_EQ(mesh.known_edges(), count_of(1));
  EXPECT_EQ(mesh.known_triangles(), no_id);
  mesh.simplices(lower_edges);
  EXPECT_EQ(mesh.known_triangles(), no_id);
  mesh.simplices(triangles);
  EXPECT_EQ(mesh.known_edges(), count_of(1));
  EXPECT_EQ(mesh.known_triangles(), count_of(2));
}

TEST(Enumeration, of_triangles_leaves_out_their_edges_until_someone_needs_them) {
  const Mesh mesh = holed();
  SimplexNeeds needs = triangles;
  needs.triangle_edge = false;
  const auto without = mesh.simplices(needs);
  EXPECT_EQ(without.triangle_apex.extent(0), static_cast<std::size_t>(count_of(2)));
  EXPECT_EQ(without.triangle_edge.extent(0), 0u);
  const auto with = mesh.simplices(triangles);
  EXPECT_EQ(with.triangle_apex.data(), without.triangle_apex.data());
  ASSERT_EQ(with.triangle_edge.extent(0), static_cast<std::size_t>(count_of(2)));
  for (Id f = 0; f < count_of(2); ++f)
    ASSERT_EQ(with.triangle_of(with.triangle_edge(f), with.triangle_apex(f)), f) << "triangle " << f;
  EXPECT_EQ(mesh.simplices(needs).triangle_edge.extent(0), 0u) << "nobody gets what it did not ask for";
}

TEST(Enumeration, comes_with_the_intervals) {
  const Mesh mesh = holed();
  EXPECT_EQ(mesh.interval_begin(1)(mesh.segments()), count_of(1));
  EXPECT_EQ(mesh.known_triangles(), no_id);
  EXPECT_EQ(mesh.interval_begin(2)(mesh.segments()), count_of(2));
  EXPECT_EQ(mesh.known_triangles(), count_of(2));
}

TEST(Enumeration, is_shared_by_copies_of_a_mesh) {
  const Mesh mesh = holed();
  const Mesh copy = mesh;
  const auto simplices = mesh.simplices(edges);
  EXPECT_EQ(copy.known_edges(), count_of(1));
  EXPECT_EQ(copy.simplices(edges).edge_low.data(), simplices.edge_low.data());
}

/// On the host, as what is on the worker's side may be the same memory.
TEST(Enumeration, gives_the_host_no_table_that_it_did_not_ask_for) {
  const Mesh mesh = holed();
  const auto nothing = mesh.simplices({});
  EXPECT_EQ(nothing.cells.extent(0), 0u);
  EXPECT_EQ(nothing.edge_begin.extent(0), 0u);
  const auto only_edges = mesh.simplices(edges);
  EXPECT_EQ(only_edges.edge_high.extent(0), static_cast<std::size_t>(count_of(1)));
  EXPECT_EQ(only_edges.triangle_begin.extent(0), 0u);
  EXPECT_EQ(only_edges.lower_begin.extent(0), 0u);
  EXPECT_EQ(only_edges.cells.extent(0), 0u);
  EXPECT_EQ(mesh.simplices(everything).cells.extent(0), static_cast<std::size_t>(mesh.cells()));
}

/// Tables that someone has stay as they are when more is enumerated.
TEST(Enumeration, leaves_earlier_tables_in_place) {
  const Mesh mesh = holed();
  const auto before = mesh.simplices(edges);
  const auto begin = before.edge_begin;
  const std::vector<Id> high(before.edge_high.data(), before.edge_high.data() + before.edge_high.extent(0));
  mesh.simplices(everything);
  EXPECT_EQ(mesh.simplices(everything).edge_begin.data(), begin.data());
  EXPECT_EQ(std::vector<Id>(before.edge_high.data(), before.edge_high.data() + before.edge_high.extent(0)), high);
}

TEST(Enumeration, by_several_threads_at_once_happens_once) {
  for (int again = 0; again < 10; ++again) {
    const Mesh mesh = holed();
    constexpr int threads = 8;
    std::vector<std::thread> all;
    std::atomic<int> begun{0}, wrong{0};
    std::vector<const Id*> apexes(threads), highs(threads);
    for (int i = 0; i < threads; ++i) {
      all.emplace_back([&, i] {
        ++begun;
        while (begun < threads) std::this_thread::yield();
        if (i % 4 == 1) mesh.interval_begin(2);
        if (i % 4 == 2) mesh.simplices<WorkerMemory>(lower_edges);
        if (i % 4 == 3 && mesh.known_edges() != no_id && mesh.known_edges() != count_of(1)) ++wrong;
        const auto simplices = mesh.simplices(i % 2 == 0 ? everything : triangles);
        apexes[i] = simplices.triangle_apex.data();
        highs[i] = simplices.edge_high.data();
        const Id last_edge = simplices.triangle_edge(simplices.triangle_edge.extent(0) - 1);
        if (simplices.triangle_of(last_edge, simplices.triangle_apex(simplices.triangle_apex.extent(0) - 1)) + 1 !=
            count_of(2))
          ++wrong;
      });
    }
    for (auto& thread : all) thread.join();
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(apexes, std::vector<const Id*>(threads, apexes[0]));
    EXPECT_EQ(highs, std::vector<const Id*>(threads, highs[0]));
  }
}

/// Vertices and edges whose higher neighbours are more than one thread keeps by itself, beside others.
TEST(Enumeration, of_long_rows_is_that_of_brute_force) {
  for (const Id degree : {39, 40, 41, 42, 43, 44, 63, 64, 65, 66, 67, 68, 81, 200}) {
    for (const int caps : {2, 3}) {
      const InputMesh input = cone_over_caps(degree, caps);
      const Mesh mesh = encode(input, segmentation_by(std::vector<std::int64_t>(input.points.size(), 0)));
      const BruteForce brute_force(input);
      const ExpectedSimplices expected(brute_force, mesh);
      const auto simplices = mesh.simplices(everything);
      ASSERT_EQ(mesh.known_edges(), static_cast<Id>(expected.vertices[1].size())) << degree;
      ASSERT_EQ(mesh.known_triangles(), static_cast<Id>(expected.vertices[2].size())) << degree;
      for (Id f = 0; f < mesh.known_triangles(); ++f) {
        const auto& triangle = expected.vertices[2][f];
        ASSERT_EQ(simplices.triangle_of(triangle[0], triangle[1], triangle[2]), f) << "degree " << degree;
      }
    }
  }
}

/// No mesh has more simplices a tetrahedron: there is no room for them at first.
TEST(Enumeration, of_tetrahedra_that_share_nothing) {
  constexpr Id count = 50000;
  InputMesh input;
  for (Id t = 0; t < count; ++t) {
    for (int k = 0; k < 4; ++k) input.points.push_back({1. * t, k == 1 ? 1. : 0., k > 1 ? k - 1. : 0.});
    input.tetrahedra.push_back({4 * t, 4 * t + 1, 4 * t + 2, 4 * t + 3});
  }
  const int before = host_threads();
  for (const int threads : {1, 2, 5}) {
    set_host_threads(threads);
    const Mesh mesh = encode(input, 100);
    const auto simplices = mesh.simplices(everything);
    ASSERT_EQ(mesh.known_edges(), 6 * count);
    ASSERT_EQ(mesh.known_triangles(), 4 * count);
    for (Id t = 0; t < count; ++t) {
      const Quad quad = mesh.cell_reader()(t);
      ASSERT_EQ(simplices.triangle_of(quad.a, quad.b, quad.c), 4 * t);
      ASSERT_EQ(simplices.triangle_of(quad.b, quad.c, quad.d), 4 * t + 3);
    }
  }
  set_host_threads(before);
}

/// Parts of a mesh that are far apart, and close, when their tables are joined.
TEST(Enumeration, is_the_same_on_any_number_of_threads) {
  const int before = host_threads();
  for (const Id side : {24, 48}) {
    const auto found_on = [&](int threads) {
      set_host_threads(threads);
      const Mesh mesh{Grid({side, side, side})};
      mesh.simplices(everything);
      return mesh;
    };
    const Mesh alone = found_on(1);
    const auto one = alone.simplices(everything);
    for (const int threads : {2, 5}) {
      const Mesh mesh = found_on(threads);
      const auto some = mesh.simplices(everything);
      const auto expect_equal = [&](const char* what, const auto& a, const auto& b) {
        ASSERT_EQ(a.extent(0), b.extent(0)) << what;
        EXPECT_TRUE(std::equal(a.data(), a.data() + a.extent(0), b.data())) << what << " on " << threads;
      };
      expect_equal("edge_begin", some.edge_begin, one.edge_begin);
      expect_equal("edge_low", some.edge_low, one.edge_low);
      expect_equal("edge_high", some.edge_high, one.edge_high);
      expect_equal("triangle_begin", some.triangle_begin, one.triangle_begin);
      expect_equal("triangle_apex", some.triangle_apex, one.triangle_apex);
    }
  }
  set_host_threads(before);
}

}  // namespace gale::test
