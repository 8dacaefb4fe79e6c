#include <atomic>
#include <random>
#include <thread>

#include <gtest/gtest.h>

#include <gale/base/error.hpp>
#include <gale/runtime/batches/host_worker.hpp>
#include <gale/runtime/make_structure.hpp>

#include "runtime/ways.hpp"
#include "support/brute_force.hpp"
#include "support/every_mesh.hpp"
#include "support/with_threads.hpp"

namespace gale::test {

namespace {

/// Expects the rows that a consumer gives for one vertex, in VV, VT and link.
testing::AssertionResult rows_match(Consumer& consumer, const ExpectedRows& expected, Id v) {
  const Row vv = consumer.row(Relation::VV, v);
  const Row vt = consumer.row(Relation::VT, v);
  const LinkRow link = consumer.link(v);
  // All three are valid until the next of their relation.
  if (std::vector<Id>(vv.begin(), vv.end()) != expected.vv[v]) return testing::AssertionFailure() << "VV of " << v;
  if (std::vector<Id>(vt.begin(), vt.end()) != expected.vt[v]) return testing::AssertionFailure() << "VT of " << v;
  for (Id t = 0; t < link.size(); ++t) {
    if (std::array<Id, 3>{link(t, 0), link(t, 1), link(t, 2)} != expected.link[v][t])
      return testing::AssertionFailure() << "link of " << v;
  }
  return testing::AssertionSuccess();
}

struct Holed {
  const InputMesh& input = mesh_named("holed_grid_9");
  Mesh mesh = encode(input, 7);
  ExpectedRows expected{input, brute_force_of("holed_grid_9"), mesh};
};

}  // namespace

class SweepOf : public EveryMesh {};

TEST_P(SweepOf, every_mesh_visits_each_segment_once_with_its_rows) {
  const Mesh mesh = encode(input(), segmentation());
  const ExpectedRows expected(input(), brute_force_of(mesh_name()), mesh);
  for (const NamedWay& way : ways()) {
    SCOPED_TRACE(way.name);
    const auto runtime = way.make(mesh, star_relations);
    for (const int threads : {1, 3}) {
      std::vector<std::atomic<int>> visits(mesh.segments());
      std::atomic<int> wrong{0};
      runtime->for_each_segment(star_relations, with_threads(threads), [&](int, const SegmentRows& rows) {
        ++visits[rows.segment()];
        if (!expected.match(rows, star_relations)) ++wrong;
      });
      EXPECT_EQ(wrong, 0);
      for (const auto& count : visits) ASSERT_EQ(count, 1);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, SweepOf, every_mesh_and_segmentation(), mesh_and_segmentation);

TEST(Runtime, answers_consumers_that_jump_at_random) {
  const Holed holed;
  for (const NamedWay& way : ways()) {
    for (const int consumers : {1, 2, 16}) {
      const auto runtime = way.make(holed.mesh, star_relations);
      std::atomic<int> wrong{0};
      std::vector<std::thread> threads;
      for (int i = 0; i < consumers; ++i) {
        threads.emplace_back([&, i] {
          std::mt19937 random(i);
          const auto consumer = runtime->consumer();
          for (int k = 0; k < 400; ++k) {
            if (!rows_match(*consumer, holed.expected, static_cast<Id>(random() % holed.mesh.vertices()))) ++wrong;
          }
        });
      }
      for (auto& thread : threads) thread.join();
      EXPECT_EQ(wrong, 0) << way.name << ", " << consumers << " consumers";
    }
  }
}

TEST(Runtime, serves_large_segments_between_small_ones) {
  const InputMesh input = holed_grid(18);
  const Mesh mesh = encode(input, large_and_small(input));
  const ExpectedRows expected(input, BruteForce(input), mesh);
  for (const NamedWay& way : ways()) {
    SCOPED_TRACE(way.name);
    const auto runtime = way.make(mesh, star_relations);
    std::atomic<int> wrong{0}, right{0};
    runtime->for_each_segment(star_relations, with_threads(3), [&](int, const SegmentRows& rows) {
      ++(expected.match(rows, star_relations) ? right : wrong);
    });
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(right, mesh.segments());
    const auto consumer = runtime->consumer();
    for (Id v = 0; v < mesh.vertices(); v += 210) EXPECT_TRUE(rows_match(*consumer, expected, v));
  }
}

TEST(Runtime, serves_a_sweep_whose_bodies_read_other_segments) {
  const Holed holed;
  for (const NamedWay& way : ways()) {
    const auto runtime = way.make(holed.mesh, star_relations);
    std::atomic<int> wrong{0};
    runtime->for_each_segment(Relation::VV, with_threads(4), [&](int, const SegmentRows& rows) {
      const auto consumer = runtime->consumer();
      for (const Id v : rows.interval(0)) {
        for (const Id other : rows[Relation::VV][v]) wrong += rows_match(*consumer, holed.expected, other) ? 0 : 1;
      }
    });
    EXPECT_EQ(wrong, 0) << way.name;
  }
}

TEST(Runtime, hands_an_exception_of_a_body_to_the_caller_and_goes_on) {
  const Holed holed;
  for (const NamedWay& way : ways()) {
    const auto runtime = way.make(holed.mesh, star_relations);
    for (int again = 0; again < 3; ++again) {
      const auto sweep = [&] {
        runtime->for_each_segment(star_relations, with_threads(4), [&](int, const SegmentRows& rows) {
          if (rows.segment() == holed.mesh.segments() / 2) throw std::runtime_error("enough");
        });
      };
      EXPECT_THROW(sweep(), std::runtime_error) << way.name;
    }
    std::atomic<Id> visited{0};
    runtime->for_each_segment(star_relations, with_threads(4), [&](int, const SegmentRows&) { ++visited; });
    EXPECT_EQ(visited, holed.mesh.segments()) << way.name;
  }
}

TEST(Runtime, lets_two_sweeps_run_at_once) {
  const Holed holed;
  for (const NamedWay& way : ways()) {
    const auto runtime = way.make(holed.mesh, star_relations);
    std::atomic<Id> visited{0};
    const auto sweep = [&] {
      runtime->for_each_segment(star_relations, with_threads(2), [&](int, const SegmentRows&) { ++visited; });
    };
    std::thread other(sweep);
    sweep();
    other.join();
    EXPECT_EQ(visited, 2 * holed.mesh.segments()) << way.name;
  }
}

TEST(Runtime, evicts_under_a_small_budget_and_not_under_a_large_one) {
  const Holed holed;
  for (const bool small : {true, false}) {
    StructureOptions options;
    options.way = Way::leaders;
    if (small) options.host_memory = 32768;
    const auto runtime = make_structure(holed.mesh, star_relations, options);
    const auto consumer = runtime->consumer();
    for (int pass = 0; pass < 2; ++pass) {
      for (Id v = 0; v < holed.mesh.vertices(); ++v) ASSERT_TRUE(rows_match(*consumer, holed.expected, v));
    }
    const auto leader = runtime->statistics().leaders.at(0);
    EXPECT_EQ(leader.blocks_evicted > 0, small);
    EXPECT_EQ(leader.segments_recomputed > 0, small);
    EXPECT_EQ(leader.segments_computed, holed.mesh.segments() + leader.segments_recomputed);
    if (small) EXPECT_LE(runtime->statistics().host_bytes, 32768u + 3 * 4096u);
  }
}

TEST(Runtime, counts_what_consumers_and_leaders_did) {
  const Holed holed;
  StructureOptions options;
  options.way = Way::leaders;
  options.queues = Queues::per_relation;
  const auto runtime = make_structure(holed.mesh, Relation::VV | Relation::VT, options);
  {
    const auto consumer = runtime->consumer();
    consumer->row(Relation::VV, 0);
    consumer->row(Relation::VV, 0);
  }
  const auto statistics = runtime->statistics();
  EXPECT_EQ(runtime->way(), Way::leaders);
  ASSERT_EQ(statistics.leaders.size(), 2u);
  EXPECT_EQ(name_of(statistics.leaders[0].relations), "VT");
  EXPECT_EQ(statistics.leaders[0].batches, 0);
  EXPECT_EQ(statistics.leaders[1].batches, 1);
  EXPECT_EQ(statistics.all_consumers().requests, 1);
  EXPECT_GT(statistics.all_consumers().waiting.total(), 0);
}

TEST(Runtime, says_what_it_was_not_preconditioned_for) {
  const Holed holed;
  for (const NamedWay& way : ways()) {
    const auto runtime = way.make(holed.mesh, Relation::VV);
    const auto consumer = runtime->consumer();
    EXPECT_THROW(consumer->row(Relation::VT, 0), Error) << way.name;
    EXPECT_EQ(consumer->row(Relation::VV, 0).size(), static_cast<Id>(holed.expected.vv[0].size()));
    EXPECT_THROW(runtime->for_each_segment(star_relations, with_threads(1), [](int, const SegmentRows&) {}), Error)
        << way.name;
    EXPECT_THROW(consumer->row(Relation::EF, 0), Error) << way.name;
    EXPECT_THROW(way.make(holed.mesh, RelationSet()), Error);
  }
}

TEST(Runtime, refuses_a_vertex_that_is_not_there) {
  const Holed holed;
  for (const NamedWay& way : ways()) {
    const auto runtime = way.make(holed.mesh, star_relations);
    const auto consumer = runtime->consumer();
    const Row row = consumer->row(Relation::VV, 0);
    for (const Id vertex : {-1, holed.mesh.vertices()}) {
      EXPECT_THROW(consumer->row(Relation::VV, vertex), Error) << way.name;
      EXPECT_THROW(consumer->link(vertex), Error) << way.name;
    }
    EXPECT_EQ(row.size(), consumer->row(Relation::VV, 0).size());
  }
}

TEST(Runtime, that_ends_tells_consumers_that_go_on_asking) {
  const Holed holed;
  StructureOptions options;
  options.way = Way::leaders;
  auto runtime = make_structure(holed.mesh, star_relations, options);
  std::vector<std::thread> threads;
  std::atomic<int> begun{0}, told{0};
  for (int i = 0; i < 4; ++i) {
    std::shared_ptr<Consumer> consumer = runtime->consumer();
    threads.emplace_back([&, i, consumer] {
      std::mt19937 random(i);
      try {
        for (;;) {
          consumer->row(Relation::VV, static_cast<Id>(random() % holed.mesh.vertices()));
          if (begun < 4) ++begun;
        }
      } catch (const Error&) {
        ++told;
      }
    });
  }
  while (begun < 4) std::this_thread::yield();
  runtime.reset();
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(told, 4);
}

}  // namespace gale::test
