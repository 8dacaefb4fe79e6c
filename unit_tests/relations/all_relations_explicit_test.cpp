#ifdef GALE_ENABLE_KOKKOS_KERNELS

#include <atomic>

#include <gtest/gtest.h>

#include <gale/base/error.hpp>
#include <gale/runtime/explicit/explicit_structure.hpp>

#include "relations/every_relation_mesh.hpp"

namespace gale::test {

namespace {

testing::AssertionResult swept_rows(Structure& structure, RelationSet wanted, int threads,
                                    const ExpectedRows& expected) {
  SweepOptions options;
  options.threads = threads;
  std::vector<testing::AssertionResult> result(threads, testing::AssertionSuccess());
  std::vector<std::atomic<int>> visits(structure.mesh().segments());
  structure.for_each_segment(wanted, options, [&](int consumer, const SegmentRows& rows) {
    ++visits[rows.segment()];
    if (result[consumer]) result[consumer] = expected.match(rows, wanted);
  });
  for (const auto& of_consumer : result) {
    if (!of_consumer) return of_consumer;
  }
  for (const auto& count : visits) {
    if (count != 1) return testing::AssertionFailure() << "a segment was visited " << count << " times";
  }
  return testing::AssertionSuccess();
}

}  // namespace

class ExplicitRowsOf : public EveryRelationMesh {};

TEST_P(ExplicitRowsOf, every_mesh_are_those_of_brute_force_for_each_relation_and_for_all_together) {
  for (const Relation relation : members_of((all_relations | link_form))) {
    ExplicitStructure structure(fresh_mesh(), relation);
    EXPECT_TRUE(swept_rows(structure, relation, 1, expected));
  }
  ExplicitStructure structure(mesh, (all_relations | link_form));
  EXPECT_EQ(structure.relations(), (all_relations | link_form));
  EXPECT_TRUE(swept_rows(structure, (all_relations | link_form), 2, expected));
}

INSTANTIATE_TEST_SUITE_P(Tests, ExplicitRowsOf, every_relation_mesh_and_segmentation(), mesh_and_segmentation);

TEST(ExplicitRows, are_read_in_any_order) {
  const InputMesh& input = mesh_named("holed_grid_9");
  const Mesh mesh = encode(input, 7);
  const ExpectedRows expected(input, brute_force_of("holed_grid_9"), mesh, (all_relations | link_form));
  ExplicitStructure structure(mesh, (all_relations | link_form));
  const auto consumer = structure.consumer();
  for (const Relation relation : members_of(all_relations)) {
    const Id rows = static_cast<Id>(expected[relation].size());
    for (Id i = 0; i < 200; ++i)
      ASSERT_TRUE(expected.match(relation, i * 1009 % rows, consumer->row(relation, i * 1009 % rows)));
    for (const Id outside : {Id(-1), rows}) EXPECT_THROW(consumer->row(relation, outside), Error) << name_of(relation);
  }
  for (Id v = 0; v < mesh.vertices(); v += 5) ASSERT_TRUE(expected.match(v, consumer->link(v)));
}

TEST(ExplicitRows, of_edges_and_triangles_around_a_vertex_of_degree_2000) {
  const InputMesh& input = mesh_named("cone_over_sphere_2000");
  const Mesh mesh = encode(input, 300);
  for (const Relation relation : {Relation::EE, Relation::FF}) {
    const ExpectedRows expected(input, brute_force_of("cone_over_sphere_2000"), mesh, relation);
    ExplicitStructure structure(mesh, relation);
    EXPECT_TRUE(swept_rows(structure, relation, 2, expected)) << name_of(relation);
  }
}

}  // namespace gale::test

#endif
