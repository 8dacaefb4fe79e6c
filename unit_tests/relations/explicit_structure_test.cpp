#include <gtest/gtest.h>

#include <gale/base/error.hpp>
#include <gale/relations/detail/global_rows.hpp>
#include <gale/relations/explicit_structure.hpp>

#include "relations/star_subsets.hpp"
#include "support/brute_force.hpp"
#include "support/every_mesh.hpp"

namespace gale::test {

namespace {

template <class Body>
std::string refusal_of(const Body& body) {
  try {
    body();
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

Mesh one_tetrahedron() { return encode(mesh_named("one_tetrahedron"), segmentation_by({0, 0, 1, 1})); }

}  // namespace

TEST(ExplicitStructureErrors, name_the_relation_that_has_too_many_entries_and_their_number) {
  EXPECT_NO_THROW(detail::require_countable(Relation::VT, 2147483647));
  EXPECT_EQ(refusal_of([] { detail::require_countable(Relation::VV, 2147483648); }),
            "the explicit structure can't hold the 2147483648 entries of VV: at most 2147483647 fit");
}

TEST(ExplicitStructureErrors, name_a_relation_that_it_does_not_have) {
  EXPECT_EQ(refusal_of([] { ExplicitStructure(one_tetrahedron(), Relation::VV | Relation::EF | Relation::TT); }),
            "the explicit structure has VT, VV, link, not EF");
}

#ifndef GALE_ENABLE_KOKKOS_KERNELS

TEST(ExplicitStructureErrors, without_kokkos_kernels_name_the_option) {
  EXPECT_EQ(
      refusal_of([] { ExplicitStructure(one_tetrahedron(), Relation::VV); }),
      "the explicit structure is computed with Kokkos-Kernels, which this GALE was built without: configure it with "
      "GALE_ENABLE_KOKKOS_KERNELS=ON");
}

#else

namespace {

SweepOptions with_threads(int threads) {
  SweepOptions options;
  options.threads = threads;
  return options;
}

/// Sweeps, and compares the rows of each segment; returns how many it saw.
Id expect_sweep(ExplicitStructure& structure, RelationSet wanted, int threads, const ExpectedRows& expected) {
  std::vector<testing::AssertionResult> result(threads, testing::AssertionSuccess());
  std::atomic<Id> segments{0};
  structure.for_each_segment(wanted, with_threads(threads), [&](int consumer, const SegmentRows& rows) {
    const auto& begin = structure.mesh().vertex_begin();
    const bool placed = rows.first() == begin(rows.segment()) && rows.last() == begin(rows.segment() + 1);
    if (result[consumer] && !placed)
      result[consumer] = testing::AssertionFailure() << "segment " << rows.segment() << " is elsewhere";
    if (result[consumer]) result[consumer] = expected.match(rows, wanted);
    ++segments;
  });
  for (const auto& of_consumer : result) EXPECT_TRUE(of_consumer) << "wanted " << name_of(wanted);
  return segments;
}

}  // namespace

class ExplicitStructureOf : public EveryMesh {};

TEST_P(ExplicitStructureOf, every_mesh_has_the_rows_of_brute_force) {
  const Mesh mesh = encode(input(), segmentation());
  const ExpectedRows expected(input(), brute_force_of(mesh_name()), mesh);
  for (const RelationSet wanted : star_subsets) {
    ExplicitStructure structure(mesh, wanted);
    EXPECT_EQ(structure.relations(), wanted);
    EXPECT_EQ(expect_sweep(structure, wanted, 2, expected), mesh.segments());
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, ExplicitStructureOf, every_mesh_and_segmentation(), mesh_and_segmentation);

TEST(ExplicitStructure, sweeps_with_any_number_of_threads) {
  const InputMesh& input = mesh_named("holed_grid_9");
  const Mesh mesh = encode(input, octree_of(input, 7));
  const ExpectedRows expected(input, brute_force_of("holed_grid_9"), mesh);
  ExplicitStructure structure(mesh, star_relations);
  for (const int threads : {1, 2, 8}) {
    for (const RelationSet wanted : star_subsets)
      EXPECT_EQ(expect_sweep(structure, wanted, threads, expected), mesh.segments());
  }
}

TEST(ExplicitStructure, reads_rows_in_any_order) {
  const InputMesh& input = mesh_named("random_tetrahedra");
  const Mesh mesh = encode(input, octree_of(input, 7));
  const ExpectedRows expected(input, brute_force_of("random_tetrahedra"), mesh);
  ExplicitStructure structure(mesh, star_relations);
  const auto consumer = structure.consumer();
  for (Id i = 0; i < 2 * mesh.vertices(); ++i) {
    const Id v = i * 37 % mesh.vertices();
    const Row vv = consumer->row(Relation::VV, v), vt = consumer->row(Relation::VT, v);
    EXPECT_EQ(std::vector<Id>(vv.begin(), vv.end()), expected.vv[v]);
    EXPECT_EQ(std::vector<Id>(vt.begin(), vt.end()), expected.vt[v]);
    ASSERT_EQ(consumer->link(v).size(), vt.size());
    EXPECT_EQ(consumer->link(v)(0, 2), expected.link[v][0][2]);
  }
}

TEST(ExplicitStructure, holds_rows_of_70000) {
  const InputMesh input = cone_over_disc(70000);
  const Mesh mesh = encode(input, octree_of(input, 100));
  const ExpectedRows expected(input, BruteForce(input), mesh);
  ExplicitStructure structure(mesh, star_relations);
  EXPECT_EQ(structure.consumer()->link(0).width, 4);
  EXPECT_EQ(expect_sweep(structure, star_relations, 2, expected), mesh.segments());
}

TEST(ExplicitStructure, outlives_the_mesh_that_it_was_made_of) {
  auto mesh = std::make_unique<Mesh>(one_tetrahedron());
  ExplicitStructure structure(*mesh, Relation::VV);
  mesh.reset();
  EXPECT_EQ(structure.mesh().vertices(), 4);
  EXPECT_EQ(structure.consumer()->row(Relation::VV, 3).size(), 3);
}

TEST(ExplicitStructureErrors, name_what_it_was_not_preconditioned_for) {
  ExplicitStructure structure(one_tetrahedron(), Relation::VV);
  const std::string message =
      "the structure was preconditioned for VV, not for VT: name every relation that you read when you construct it";
  EXPECT_EQ(refusal_of([&] { structure.for_each_segment(Relation::VT, {}, [](int, const SegmentRows&) {}); }), message);
  EXPECT_EQ(refusal_of([&] { structure.consumer()->row(Relation::VT, 0); }), message);
}

TEST(ExplicitStructureErrors, name_a_vertex_that_is_not_there) {
  ExplicitStructure structure(one_tetrahedron(), Relation::VV);
  const auto consumer = structure.consumer();
  EXPECT_EQ(refusal_of([&] { consumer->row(Relation::VV, 4); }), "there is no vertex 4: the mesh has 0 to 3");
  EXPECT_EQ(refusal_of([&] { consumer->row(Relation::VV, -1); }), "there is no vertex -1: the mesh has 0 to 3");
  EXPECT_EQ(consumer->row(Relation::VV, 3).size(), 3);
}

TEST(ExplicitStructureErrors, come_out_of_a_sweep_from_the_body_that_threw) {
  const InputMesh& input = mesh_named("holed_grid_9");
  ExplicitStructure structure(encode(input, octree_of(input, 1)), Relation::VV);
  const auto body = [](int, const SegmentRows& rows) {
    if (rows.segment() == 100) throw Error("segment 100");
  };
  EXPECT_EQ(refusal_of([&] { structure.for_each_segment(Relation::VV, with_threads(4), body); }), "segment 100");
}

#endif

}  // namespace gale::test
