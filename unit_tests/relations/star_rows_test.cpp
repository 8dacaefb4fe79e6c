#include <gtest/gtest.h>

#include <gale/base/threads.hpp>
#include <gale/runtime/batches/host_worker.hpp>

#include "relations/star_subsets.hpp"
#include "support/brute_force.hpp"
#include "support/every_mesh.hpp"

namespace gale::test {

namespace {

std::vector<Id> ids_in(const Row& row) { return {row.begin(), row.end()}; }

void expect_rows(const Mesh& mesh, RelationSet wanted, const ExpectedRows& expected) {
  HostWorker worker(mesh, wanted);
  for (Id s = 0; s < mesh.segments(); ++s) {
    const SegmentRows rows = worker.compute(s);
    EXPECT_EQ(rows.segment(), s);
    EXPECT_EQ(rows.interval(0).first, mesh.vertex_begin()(s));
    EXPECT_EQ(rows.interval(0).last, mesh.vertex_begin()(s + 1));
    ASSERT_TRUE(expected.match(rows, wanted)) << "wanted " << name_of(wanted);
  }
}

}  // namespace

class StarRowsOf : public EveryMesh {};

TEST_P(StarRowsOf, every_mesh_are_those_of_brute_force) {
  const Mesh mesh = encode(input(), segmentation());
  const ExpectedRows expected(input(), brute_force_of(mesh_name()), mesh);
  for (const RelationSet wanted : star_subsets) expect_rows(mesh, wanted, expected);
}

INSTANTIATE_TEST_SUITE_P(Tests, StarRowsOf, every_mesh_and_segmentation(), mesh_and_segmentation);

TEST(StarRows, of_the_papers_example) {
  const Mesh mesh = encode(mesh_named("the_papers"), segmentation_by({1, 1, 1, 2, 2, 2}));
  HostWorker worker(mesh, star_relations);
  const std::vector<Id> vv[] = {{1, 2, 3, 4}, {0, 2, 3}, {0, 1, 3, 4, 5}, {0, 1, 2, 4, 5}, {0, 2, 3, 5}, {2, 3, 4}};
  const std::vector<Id> vt[] = {{0, 1}, {0}, {0, 1, 2}, {0, 1, 2}, {1, 2}, {2}};
  for (Id s = 0; s < 2; ++s) {
    const SegmentRows rows = worker.compute(s);
    for (const Id v : rows.interval(0)) {
      EXPECT_EQ(ids_in(rows[Relation::VV][v]), vv[v]);
      EXPECT_EQ(ids_in(rows[Relation::VT][v]), vt[v]);
    }
  }
  // Tetrahedron 1 is (0, 2, 3, 4): at vertex 2 its others are entries 0, 2 and 3 of 0 1 3 4 5.
  const LinkRow link = worker.compute(0).links()[2];
  ASSERT_EQ(link.size(), 3);
  EXPECT_EQ(link(1, 0), 0);
  EXPECT_EQ(link(1, 1), 2);
  EXPECT_EQ(link(1, 2), 3);
}

TEST(StarRows, of_isolated_vertices_are_empty) {
  const Mesh mesh = encode(mesh_named("isolated_vertices"), 1);
  HostWorker worker(mesh, star_relations);
  for (const Id isolated : {0, 1, 4, 8}) {
    const Id v = mesh.vertex_internal()(isolated);
    const SegmentRows rows = worker.compute(mesh.segment_of(0, v));
    EXPECT_EQ(rows[Relation::VV][v].size(), 0);
    EXPECT_EQ(rows[Relation::VT][v].size(), 0);
    EXPECT_EQ(rows.links()[v].size(), 0);
  }
}

/// A worker's memory grows when a segment needs more, and serves smaller ones after that.
TEST(StarRows, of_small_segments_between_large_ones) {
  const InputMesh& input = mesh_named("cone_over_sphere_2000");
  std::vector<std::int64_t> labels(input.points.size());
  for (std::size_t v = 0; v < labels.size(); ++v) labels[v] = v < 40 ? v : v < 1000 ? 40 : v < 1040 ? v : 2000;
  const Mesh mesh = encode(input, segmentation_by(labels));
  const ExpectedRows expected(input, brute_force_of("cone_over_sphere_2000"), mesh);
  for (const RelationSet wanted : star_subsets) {
    HostWorker worker(mesh, wanted);
    const Id last = mesh.segments() - 1;
    for (const Id s : {Id(30), Id(0), Id(31), Id(40), Id(5), last, Id(60), Id(0), last}) {
      ASSERT_TRUE(expected.match(worker.compute(s), wanted)) << "wanted " << name_of(wanted);
    }
  }
}

/// So long a row that a place in it takes 4 bytes.
TEST(StarRows, of_a_vertex_of_degree_70000) {
  const InputMesh input = cone_over_disc(70000);
  const Mesh mesh = encode(input, 100);
  const ExpectedRows expected(input, BruteForce(input), mesh);
  HostWorker worker(mesh, star_relations);
  const SegmentRows rows = worker.compute(mesh.segment_of(0, mesh.vertex_internal()(0)));
  EXPECT_EQ(rows.links()[mesh.vertex_internal()(0)].width, 4);
  EXPECT_TRUE(expected.match(rows, star_relations));
}

TEST(StarRows, by_workers_on_several_threads_at_once) {
  const InputMesh& input = mesh_named("holed_grid_9");
  const Mesh mesh = encode(input, 7);
  const ExpectedRows expected(input, brute_force_of("holed_grid_9"), mesh);
  constexpr int threads = 8;
  std::vector<testing::AssertionResult> result(threads, testing::AssertionSuccess());
  on_threads(threads, [&](int thread) {
    HostWorker worker(mesh, star_relations);
    for (Id i = 0; i < mesh.segments() && result[thread]; ++i) {
      const Id s = (i * (2 * thread + 1)) % mesh.segments();
      result[thread] = expected.match(worker.compute(s), star_relations);
    }
  });
  for (const auto& of_thread : result) EXPECT_TRUE(of_thread);
}

TEST(StarRows, of_a_worker_that_was_moved) {
  const InputMesh& input = mesh_named("holed_grid_9");
  const Mesh mesh = encode(input, 100);
  const ExpectedRows expected(input, brute_force_of("holed_grid_9"), mesh);
  HostWorker first(mesh, star_relations);
  first.compute(0);
  HostWorker second(std::move(first));
  EXPECT_TRUE(expected.match(second.compute(1), star_relations));
}

}  // namespace gale::test
