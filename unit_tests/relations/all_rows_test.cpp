#include <gtest/gtest.h>

#include <gale/base/threads.hpp>
#include <gale/runtime/batches/host_worker.hpp>

#include "relations/every_relation_mesh.hpp"

namespace gale::test {

namespace {

testing::AssertionResult produced_rows(const Mesh& mesh, RelationSet wanted, const ExpectedRows& expected) {
  HostWorker worker(mesh, wanted);
  for (Id s = 0; s < mesh.segments(); ++s) {
    const auto result = expected.match(worker.compute(s), wanted);
    if (!result) return result;
  }
  return testing::AssertionSuccess();
}

}  // namespace

class RowsOf : public EveryRelationMesh {};

TEST_P(RowsOf, every_mesh_are_those_of_brute_force_for_each_relation_and_for_all_together) {
  for (const Relation relation : members_of((all_relations | link_form))) {
    EXPECT_TRUE(produced_rows(fresh_mesh(), relation, expected));
  }
  EXPECT_TRUE(produced_rows(mesh, (all_relations | link_form), expected));
}

INSTANTIATE_TEST_SUITE_P(Tests, RowsOf, every_relation_mesh_and_segmentation(), mesh_and_segmentation);

/// Tetrahedra (0 1 2 3), (0 2 3 4) and (2 3 4 5). Edges: 01 02 03 04 12 13 23 24 25 34 35 45. Triangles: 012 013 023
/// 024 034 123 234 235 245 345.
TEST(Rows, of_the_papers_example) {
  const Mesh mesh = encode(mesh_named("the_papers"), segmentation_by({1, 1, 1, 2, 2, 2}));
  HostWorker worker(mesh, (all_relations | link_form));
  const SegmentRows rows = worker.compute(0);
  const auto row = [&](Relation relation, Id simplex) {
    const Row found = rows[relation][simplex];
    return std::vector<Id>(found.begin(), found.end());
  };
  using Ids = std::vector<Id>;
  EXPECT_EQ(row(Relation::EV, 8), (Ids{2, 5}));
  EXPECT_EQ(row(Relation::FV, 4), (Ids{0, 3, 4}));
  EXPECT_EQ(row(Relation::FE, 4), (Ids{2, 3, 9}));
  EXPECT_EQ(row(Relation::TV, 1), (Ids{0, 2, 3, 4}));
  EXPECT_EQ(row(Relation::TE, 1), (Ids{1, 2, 3, 6, 7, 9}));
  EXPECT_EQ(row(Relation::TF, 1), (Ids{2, 3, 4, 6}));
  EXPECT_EQ(row(Relation::VE, 1), (Ids{0, 4, 5}));
  EXPECT_EQ(row(Relation::VF, 1), (Ids{0, 1, 5}));
  EXPECT_EQ(row(Relation::VT, 2), (Ids{0, 1, 2}));
  EXPECT_EQ(row(Relation::EF, 6), (Ids{2, 5, 6, 7}));
  EXPECT_EQ(row(Relation::ET, 6), (Ids{0, 1, 2}));
  EXPECT_EQ(row(Relation::FT, 6), (Ids{1, 2}));
  EXPECT_EQ(row(Relation::VV, 1), (Ids{0, 2, 3}));
  EXPECT_EQ(row(Relation::EE, 0), (Ids{1, 2, 3, 4, 5}));
  EXPECT_EQ(row(Relation::FF, 0), (Ids{1, 2, 3, 5}));
  EXPECT_EQ(row(Relation::TT, 0), (Ids{1}));
  EXPECT_EQ(row(Relation::TT, 1), (Ids{0, 2}));
}

/// Edges at the apex have some 2000 neighbours each, and so have triangles at the edges from the apex to a cap.
TEST(Rows, of_edges_and_triangles_around_a_vertex_of_degree_2000) {
  const InputMesh& input = mesh_named("cone_over_sphere_2000");
  const Mesh mesh = encode(input, 300);
  for (const Relation relation : {Relation::EE, Relation::FF}) {
    const ExpectedRows expected(input, brute_force_of("cone_over_sphere_2000"), mesh, relation);
    EXPECT_TRUE(produced_rows(mesh, relation, expected));
  }
}

TEST(Rows, of_all_relations_by_workers_on_several_threads_at_once) {
  const InputMesh& input = mesh_named("holed_grid_9");
  const Mesh mesh = encode(input, 100);
  const ExpectedRows expected(input, brute_force_of("holed_grid_9"), mesh, (all_relations | link_form));
  constexpr int threads = 8;
  std::vector<testing::AssertionResult> result(threads, testing::AssertionSuccess());
  on_threads(threads, [&](int thread) { result[thread] = produced_rows(mesh, (all_relations | link_form), expected); });
  for (const auto& of_thread : result) EXPECT_TRUE(of_thread);
}

}  // namespace gale::test
