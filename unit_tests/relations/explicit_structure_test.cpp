#include <array>

#include <gtest/gtest.h>

#include <gale/base/error.hpp>
#include <gale/runtime/explicit/explicit_relations.hpp>
#include <gale/runtime/explicit/explicit_structure.hpp>

#include "relations/star_subsets.hpp"
#include "support/brute_force.hpp"
#include "support/every_mesh.hpp"
#include "support/message_of.hpp"
#include "support/with_threads.hpp"

namespace gale::test {

namespace {

Mesh one_tetrahedron() { return encode(mesh_named("one_tetrahedron"), segmentation_by({0, 0, 1, 1})); }

}  // namespace

TEST(ExplicitStructureErrors, name_the_relation_that_has_too_many_entries_and_their_number) {
  EXPECT_NO_THROW(detail::require_countable(Relation::VT, 2147483647));
  EXPECT_EQ(message_of([] { detail::require_countable(Relation::VV, 2147483648); }),
            "the explicit structure can't hold the 2147483648 entries of VV: at most 2147483647 fit");
}

#ifndef GALE_ENABLE_KOKKOS_KERNELS

TEST(ExplicitStructureErrors, without_kokkos_kernels_name_the_option) {
  EXPECT_EQ(
      message_of([] { ExplicitStructure(one_tetrahedron(), Relation::VV); }),
      "the explicit structure is computed with Kokkos-Kernels, which this GALE was built without: configure it with "
      "GALE_ENABLE_KOKKOS_KERNELS=ON");
}

#else

namespace {

/// Sweeps, and compares the rows of each segment; returns how many it saw.
Id expect_sweep(ExplicitStructure& structure, RelationSet wanted, int threads, const ExpectedRows& expected) {
  std::vector<testing::AssertionResult> result(threads, testing::AssertionSuccess());
  std::atomic<Id> segments{0};
  structure.for_each_segment(wanted, with_threads(threads), [&](int consumer, const SegmentRows& rows) {
    const auto& begin = structure.mesh().vertex_begin();
    const bool placed =
        rows.interval(0).first == begin(rows.segment()) && rows.interval(0).last == begin(rows.segment() + 1);
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
  const Mesh mesh = encode(input, 7);
  const ExpectedRows expected(input, brute_force_of("holed_grid_9"), mesh);
  ExplicitStructure structure(mesh, star_relations);
  for (const int threads : {1, 2, 8}) {
    for (const RelationSet wanted : star_subsets)
      EXPECT_EQ(expect_sweep(structure, wanted, threads, expected), mesh.segments());
  }
}

TEST(ExplicitStructure, reads_rows_in_any_order) {
  const InputMesh& input = mesh_named("random_tetrahedra");
  const Mesh mesh = encode(input, 7);
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
  const Mesh mesh = encode(input, 100);
  const ExpectedRows expected(input, BruteForce(input), mesh);
  ExplicitStructure structure(mesh, star_relations);
  EXPECT_EQ(structure.consumer()->link(0).width, 4);
  EXPECT_EQ(expect_sweep(structure, star_relations, 2, expected), mesh.segments());
}

/// Every combination of two lets go of other things on the way.
TEST(ExplicitStructure, has_the_rows_of_each_relation_and_of_each_pair) {
  const InputMesh& input = mesh_named("three_on_one_triangle");
  const Mesh mesh = encode(input, 1);
  const ExpectedRows expected(input, brute_force_of("three_on_one_triangle"), mesh, (all_relations | link_form));
  for (const Relation one : members_of((all_relations | link_form))) {
    for (const Relation other : members_of((all_relations | link_form))) {
      ExplicitStructure structure(mesh, one | other);
      EXPECT_EQ(expect_sweep(structure, one | other, 1, expected), mesh.segments());
    }
  }
}

/// Segments {0, 1, 2} and {3, 4, 5}; tetrahedra (0 1 2 3), (0 2 3 4) and (2 3 4 5). Edges: 01 02 03 04 12 13 23 24 25,
/// and 34 35 45. Triangles: 012 013 023 024 034 123 234 235 245, and 345.
TEST(ExplicitStructure, knows_which_simplices_are_internal_to_a_segment) {
  ExplicitStructure structure(encode(mesh_named("the_papers"), segmentation_by({1, 1, 1, 2, 2, 2})),
                              (all_relations | link_form));
  constexpr Interval expected[2][4] = {{{0, 3}, {0, 9}, {0, 9}, {0, 3}}, {{3, 6}, {9, 12}, {9, 10}, {3, 3}}};
  structure.for_each_segment((all_relations | link_form), with_threads(1), [&](int, const SegmentRows& rows) {
    for (int dimension = 0; dimension < 4; ++dimension) {
      EXPECT_EQ(rows.interval(dimension).first, expected[rows.segment()][dimension].first);
      EXPECT_EQ(rows.interval(dimension).last, expected[rows.segment()][dimension].last);
    }
  });
}

TEST(ExplicitStructure, reads_rows_of_any_simplices) {
  ExplicitStructure structure(encode(mesh_named("the_papers"), segmentation_by({1, 1, 1, 2, 2, 2})),
                              (all_relations | link_form));
  const auto consumer = structure.consumer();
  const auto row = [&](Relation relation, Id simplex) {
    const Row found = consumer->row(relation, simplex);
    return std::vector<Id>(found.begin(), found.end());
  };
  using Ids = std::vector<Id>;
  EXPECT_EQ(row(Relation::EV, 11), (Ids{4, 5}));
  EXPECT_EQ(row(Relation::FV, 9), (Ids{3, 4, 5}));
  EXPECT_EQ(row(Relation::FE, 2), (Ids{1, 2, 6}));
  EXPECT_EQ(row(Relation::TE, 2), (Ids{6, 7, 8, 9, 10, 11}));
  EXPECT_EQ(row(Relation::TF, 0), (Ids{0, 1, 2, 5}));
  EXPECT_EQ(row(Relation::VE, 5), (Ids{8, 10, 11}));
  EXPECT_EQ(row(Relation::VF, 1), (Ids{0, 1, 5}));
  EXPECT_EQ(row(Relation::EF, 9), (Ids{4, 6, 9}));
  EXPECT_EQ(row(Relation::ET, 9), (Ids{1, 2}));
  EXPECT_EQ(row(Relation::FT, 6), (Ids{1, 2}));
  EXPECT_EQ(row(Relation::EE, 0), (Ids{1, 2, 3, 4, 5}));
  EXPECT_EQ(row(Relation::FF, 0), (Ids{1, 2, 3, 5}));
  EXPECT_EQ(row(Relation::TT, 1), (Ids{0, 2}));
}

TEST(ExplicitStructure, numbers_no_simplices_that_it_does_not_need) {
  const auto counts = [](RelationSet wanted) {
    const ExplicitStructure structure(one_tetrahedron(), wanted);
    return std::array<Id, 4>{structure.count(0), structure.count(1), structure.count(2), structure.count(3)};
  };
  constexpr std::array<Id, 4> no_edges{4, no_id, no_id, 1}, no_triangles{4, 6, no_id, 1}, all{4, 6, 4, 1};
  for (const RelationSet wanted : {RelationSet(), RelationSet(Relation::TV), star_relations})
    EXPECT_EQ(counts(wanted), no_edges);
  for (const Relation wanted : {Relation::EV, Relation::TE, Relation::VE, Relation::ET, Relation::EE})
    EXPECT_EQ(counts(wanted), no_triangles);
  for (const Relation wanted : {Relation::FV, Relation::FE, Relation::TF, Relation::VF, Relation::EF, Relation::FT,
                                Relation::FF, Relation::TT}) {
    EXPECT_EQ(counts(wanted), all);
  }
}

TEST(ExplicitStructure, does_not_have_the_mesh_number_its_simplices) {
  const Mesh mesh = one_tetrahedron();
  ExplicitStructure structure(mesh, (all_relations | link_form));
  structure.for_each_segment((all_relations | link_form), {}, [](int, const SegmentRows&) {});
  const auto consumer = structure.consumer();
  EXPECT_EQ(consumer->row(Relation::EF, 5).size(), 2);
  EXPECT_THROW(consumer->row(Relation::FE, 4), Error);
  EXPECT_EQ(mesh.known_edges(), no_id);
  EXPECT_EQ(mesh.known_triangles(), no_id);
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
  EXPECT_EQ(message_of([&] { structure.for_each_segment(Relation::VT, {}, [](int, const SegmentRows&) {}); }), message);
  EXPECT_EQ(message_of([&] { structure.consumer()->row(Relation::VT, 0); }), message);
}

TEST(ExplicitStructureErrors, name_a_vertex_that_is_not_there) {
  ExplicitStructure structure(one_tetrahedron(), Relation::VV);
  const auto consumer = structure.consumer();
  EXPECT_EQ(message_of([&] { consumer->row(Relation::VV, 4); }), "there is no vertex 4: the mesh has 0 to 3");
  EXPECT_EQ(message_of([&] { consumer->row(Relation::VV, -1); }), "there is no vertex -1: the mesh has 0 to 3");
  EXPECT_EQ(consumer->row(Relation::VV, 3).size(), 3);
}

TEST(ExplicitStructureErrors, name_an_edge_triangle_or_tetrahedron_that_is_not_there) {
  ExplicitStructure structure(one_tetrahedron(), Relation::EV | Relation::FT | Relation::TT);
  const auto consumer = structure.consumer();
  EXPECT_EQ(message_of([&] { consumer->row(Relation::EV, 6); }), "there is no edge 6: the mesh has 0 to 5");
  EXPECT_EQ(message_of([&] { consumer->row(Relation::FT, 4); }), "there is no triangle 4: the mesh has 0 to 3");
  EXPECT_EQ(message_of([&] { consumer->row(Relation::TT, -1); }), "there is no tetrahedron -1: the mesh has 0 to 0");
  EXPECT_EQ(consumer->row(Relation::TT, 0).size(), 0);
}

TEST(ExplicitStructureErrors, come_out_of_a_sweep_from_the_body_that_threw) {
  const InputMesh& input = mesh_named("holed_grid_9");
  ExplicitStructure structure(encode(input, 1), Relation::VV);
  const auto body = [](int, const SegmentRows& rows) {
    if (rows.segment() == 100) throw Error("segment 100");
  };
  EXPECT_EQ(message_of([&] { structure.for_each_segment(Relation::VV, with_threads(4), body); }), "segment 100");
}

#endif

}  // namespace gale::test
