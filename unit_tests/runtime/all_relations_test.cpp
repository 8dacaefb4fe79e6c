#include <atomic>
#include <random>
#include <thread>

#include <gtest/gtest.h>

#include <gale/base/error.hpp>
#include <gale/runtime/make_structure.hpp>

#include "runtime/ways.hpp"
#include "support/brute_force.hpp"
#include "support/every_mesh.hpp"
#include "support/message_of.hpp"
#include "support/with_threads.hpp"

namespace gale::test {

namespace {

constexpr RelationSet mixed_sets[] = {
    all_relations | link_form,
    Relation::FE | Relation::TT,
    Relation::TV | Relation::EF | Relation::FF,
    Relation::VE | Relation::VV | Relation::EV,
    Relation::TF | Relation::ET | link_form | Relation::EE,
    face_relations,
    coboundary_relations,
    adjacency_relations,
};

/// Sweeps, and compares the rows of each segment, which must come once.
void expect_sweep(Structure& structure, RelationSet wanted, int threads, const ExpectedRows& expected) {
  std::vector<std::atomic<int>> visits(structure.mesh().segments());
  std::vector<testing::AssertionResult> result(threads, testing::AssertionSuccess());
  structure.for_each_segment(wanted, with_threads(threads), [&](int consumer, const SegmentRows& rows) {
    ++visits[rows.segment()];
    if (result[consumer]) result[consumer] = expected.match(rows, wanted);
  });
  for (const auto& of_consumer : result)
    EXPECT_TRUE(of_consumer) << "wanted " << name_of(wanted) << " by " << threads << " threads";
  for (const auto& count : visits) ASSERT_EQ(count, 1);
}

struct Fixture {
  const char* name;
  const InputMesh& input = mesh_named(name);
  Mesh mesh = encode(input, 7);
  ExpectedRows expected{input, brute_force_of(name), mesh, (all_relations | link_form)};

  explicit Fixture(const char* mesh_name) : name(mesh_name) {}

  /// How many rows one relation has, or the links.
  Id rows(RelationSet one) const {
    return one == link_form ? mesh.vertices() : static_cast<Id>(expected[members_of(one).front()].size());
  }

  /// Asks a consumer for a row, and compares it.
  testing::AssertionResult matches(Consumer& consumer, RelationSet one, Id simplex) const {
    if (one == link_form) return expected.match(simplex, consumer.link(simplex));
    const Relation relation = members_of(one).front();
    return expected.match(relation, simplex, consumer.row(relation, simplex));
  }
};

}  // namespace

class MixedSweepOf : public EveryMesh {};

TEST_P(MixedSweepOf, small_meshes_have_the_rows_of_brute_force) {
  const Mesh mesh = encode(input(), segmentation());
  const ExpectedRows expected(input(), brute_force_of(mesh_name()), mesh, (all_relations | link_form));
  for (const NamedWay& way : ways()) {
    SCOPED_TRACE(way.name);
    const auto runtime = way.make(mesh, (all_relations | link_form));
    expect_sweep(*runtime, (all_relations | link_form), 2, expected);
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, MixedSweepOf,
                         testing::Combine(testing::Values("the_papers", "two_sharing_an_edge", "isolated_vertices",
                                                          "several_components", "seven_on_one_triangle",
                                                          "random_tetrahedra", "cone_over_sphere_200", "thick_shell"),
                                          testing::ValuesIn(segmentation_names())),
                         mesh_and_segmentation);

TEST(MixedSweep, has_the_rows_of_brute_force_for_any_relations_and_threads) {
  const Fixture holed("holed_grid_9");
  for (const NamedWay& way : ways()) {
    SCOPED_TRACE(way.name);
    for (const RelationSet wanted : mixed_sets) {
      const auto runtime = way.make(holed.mesh, wanted);
      for (const int threads : {1, 2, 8}) expect_sweep(*runtime, wanted, threads, holed.expected);
    }
  }
}

TEST(MixedSweep, of_some_of_the_relations_that_were_preconditioned) {
  const Fixture holed("holed_grid_9");
  for (const NamedWay& way : ways()) {
    SCOPED_TRACE(way.name);
    const auto runtime = way.make(holed.mesh, (all_relations | link_form));
    for (const RelationSet wanted : mixed_sets) expect_sweep(*runtime, wanted, 2, holed.expected);
  }
}

TEST(MixedConsumers, that_jump_at_random_get_the_rows_of_brute_force) {
  const Fixture holed("holed_grid_9");
  const auto relations = members_of(all_relations);
  std::vector<RelationSet> members(relations.begin(), relations.end());
  members.push_back(link_form);
  for (const NamedWay& way : ways()) {
    for (const int consumers : {1, 2, 8}) {
      const auto runtime = way.make(holed.mesh, (all_relations | link_form));
      std::vector<testing::AssertionResult> result(consumers, testing::AssertionSuccess());
      std::vector<std::thread> threads;
      for (int i = 0; i < consumers; ++i) {
        threads.emplace_back([&, i] {
          std::mt19937 random(i);
          const auto consumer = runtime->consumer();
          for (int k = 0; k < 1500 && result[i]; ++k) {
            const RelationSet one = members[random() % members.size()];
            result[i] = holed.matches(*consumer, one, static_cast<Id>(random() % holed.rows(one)));
          }
        });
      }
      for (auto& thread : threads) thread.join();
      for (const auto& of_consumer : result) EXPECT_TRUE(of_consumer) << way.name << ", " << consumers << " consumers";
    }
  }
}

/// A row stays valid until the consumer asks for its next of the same relation, whatever it reads in between.
TEST(MixedConsumers, keep_a_row_while_they_read_any_number_of_others) {
  const Fixture holed("holed_grid_9");
  const auto members = members_of(all_relations);
  for (const NamedWay& way : ways()) {
    const auto runtime = way.make(holed.mesh, (all_relations | link_form));
    for (const Relation kept : members) {
      const auto consumer = runtime->consumer();
      const Id simplex = holed.rows(kept) - 1;  // of a segment that the others don't touch
      const Row row = consumer->row(kept, simplex);
      for (const Relation other : members) {
        if (other == kept) continue;
        for (Id i = 0; i < 50; ++i) consumer->row(other, holed.rows(other) / 60 * i);
      }
      EXPECT_TRUE(holed.expected.match(kept, simplex, row)) << way.name;
      EXPECT_TRUE(holed.matches(*consumer, kept, simplex)) << way.name;
    }
  }
}

TEST(MixedConsumers, read_beside_a_sweep_and_inside_of_it) {
  const Fixture holed("holed_grid_9");
  for (const NamedWay& way : ways()) {
    const auto runtime = way.make(holed.mesh, (all_relations | link_form));
    std::vector<testing::AssertionResult> result(4, testing::AssertionSuccess());
    std::vector<std::unique_ptr<Consumer>> consumers;
    for (int i = 0; i < 4; ++i) consumers.push_back(runtime->consumer());
    runtime->for_each_segment(Relation::VE | Relation::EV, with_threads(4), [&](int number, const SegmentRows& rows) {
      for (const Id v : rows.interval(0)) {
        for (const Id edge : rows[Relation::VE][v]) {
          if (result[number]) result[number] = holed.matches(*consumers[number], Relation::ET, edge);
        }
      }
    });
    for (const auto& of_consumer : result) EXPECT_TRUE(of_consumer) << way.name;
  }
}

TEST(MixedRuntime, evicts_blocks_under_a_small_budget) {
  const Fixture holed("holed_grid_9");
  StructureOptions options;
  options.way = Way::leaders;
  options.host_memory = 1 << 16;
  const auto runtime = make_structure(holed.mesh, Relation::EF | Relation::FF, options);
  const auto consumer = runtime->consumer();
  for (int pass = 0; pass < 2; ++pass) {
    for (Id e = 0; e < holed.rows(Relation::EF); e += 7) ASSERT_TRUE(holed.matches(*consumer, Relation::EF, e));
    for (Id f = 0; f < holed.rows(Relation::FF); f += 7) ASSERT_TRUE(holed.matches(*consumer, Relation::FF, f));
  }
  for (const auto& leader : runtime->statistics().leaders) {
    EXPECT_GT(leader.blocks_evicted, 0) << name_of(leader.relations);
    EXPECT_GT(leader.segments_recomputed, 0) << name_of(leader.relations);
  }
}

TEST(MixedRuntime, has_no_leaders_for_face_relations) {
  const Fixture papers("the_papers");
  StructureOptions options;
  options.way = Way::leaders;
  EXPECT_TRUE(make_structure(papers.mesh, face_relations, options)->statistics().leaders.empty());
  const auto leaders = make_structure(papers.mesh, (all_relations | link_form), options)->statistics().leaders;
  ASSERT_EQ(leaders.size(), 9u);
  EXPECT_EQ(name_of(leaders.front().relations), "VE");
  EXPECT_EQ(leaders.back().relations, star_relations);
}

TEST(MixedRuntime, enumerates_no_more_than_its_relations_need) {
  const InputMesh& input = mesh_named("ball");
  for (const NamedWay& way : ways()) {
    const Mesh mesh = encode(input, 7);
    const auto stars = way.make(mesh, star_relations | Relation::TV);
    stars->consumer()->row(Relation::TV, 0);
    stars->for_each_segment(star_relations | Relation::TV, with_threads(1), [](int, const SegmentRows&) {});
    EXPECT_EQ(mesh.known_edges(), no_id) << way.name;
    const auto edges = way.make(mesh, Relation::VE | Relation::TT);
    EXPECT_NE(mesh.known_edges(), no_id) << way.name << ": before the first row";
    edges->consumer()->row(Relation::TT, 0);
    EXPECT_EQ(mesh.known_triangles(), no_id) << way.name;
    const auto triangles = way.make(mesh, Relation::FV);
    EXPECT_NE(mesh.known_triangles(), no_id) << way.name;
  }
}

TEST(MixedRuntime, says_what_it_was_not_preconditioned_for) {
  const Fixture papers("the_papers");
  for (const NamedWay& way : ways()) {
    SCOPED_TRACE(way.name);
    const auto runtime = way.make(papers.mesh, Relation::EF | Relation::FV);
    const auto consumer = runtime->consumer();
    const std::string expected = "the structure was preconditioned for FV, EF, not for ";
    const std::string what_to_do = ": name every relation that you read when you construct it";
    for (const Relation relation : members_of(all_relations - (Relation::EF | Relation::FV))) {
      EXPECT_EQ(message_of([&] { consumer->row(relation, 0); }), expected + name_of(relation) + what_to_do);
      const auto sweep = [&] {
        runtime->for_each_segment(relation | Relation::EF, {}, [](int, const SegmentRows&) { FAIL(); });
      };
      EXPECT_EQ(message_of(sweep), expected + name_of(relation) + what_to_do);
    }
    EXPECT_EQ(message_of([&] { consumer->link(0); }), expected + "link" + what_to_do);
    EXPECT_TRUE(papers.matches(*consumer, Relation::EF, 6)) << "it goes on";
  }
}

/// The paper's example has 6 vertices, 12 edges, 10 triangles and 3 tetrahedra.
TEST(MixedRuntime, names_a_simplex_that_is_not_there) {
  const Fixture papers("the_papers");
  for (const NamedWay& way : ways()) {
    SCOPED_TRACE(way.name);
    const auto runtime = way.make(papers.mesh, (all_relations | link_form));
    const auto consumer = runtime->consumer();
    for (const Id outside : {-1, 1000}) {
      const std::string there_is_no[] = {
          "there is no vertex " + std::to_string(outside) + ": the mesh has 0 to 5",
          "there is no edge " + std::to_string(outside) + ": the mesh has 0 to 11",
          "there is no triangle " + std::to_string(outside) + ": the mesh has 0 to 9",
          "there is no tetrahedron " + std::to_string(outside) + ": the mesh has 0 to 2"};
      for (const Relation relation : members_of(all_relations)) {
        EXPECT_EQ(message_of([&] { consumer->row(relation, outside); }), there_is_no[row_dimension(relation)])
            << name_of(relation);
      }
    }
    EXPECT_EQ(message_of([&] { consumer->row(Relation::FV, 10); }), "there is no triangle 10: the mesh has 0 to 9");
    EXPECT_TRUE(papers.matches(*consumer, Relation::FV, 9));
  }
}

}  // namespace gale::test
