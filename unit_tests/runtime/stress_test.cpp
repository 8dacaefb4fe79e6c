#include <cstdlib>
#include <new>
#include <random>
#include <thread>

#include <gtest/gtest.h>

#include <gale/base/error.hpp>
#include <gale/base/threads.hpp>
#include <gale/runtime/leaders/leader.hpp>
#include <gale/runtime/make_structure.hpp>

#include "runtime/interrupted.hpp"
#include "runtime/ways.hpp"
#include "support/brute_force.hpp"
#include "support/segmentations.hpp"

// Everything at once: consumers that jump, sweeps, budgets that hold next to nothing, failures. Longer with
// GALE_STRESS=<times> in the environment; 300 is some minutes.

namespace gale::test {

namespace {

constexpr int consumers = 16;

int times() {
  const char* const given = std::getenv("GALE_STRESS");
  return given == nullptr ? 1 : std::atoi(given);
}

struct Stressed {
  const InputMesh& input = mesh_named("holed_grid_9");
  Mesh mesh = encode(input, 7);
  ExpectedRows expected{input, brute_force_of("holed_grid_9"), mesh};

  bool is_right(Id segment, const detail::Lease& lease) const {
    SegmentRows rows(segment, mesh.intervals_of(segment));
    add_rows(lease.arena().batch(Relation::VV, interval_tables(mesh)), lease.slot(), rows);
    return bool(expected.match(rows, Relation::VV));
  }
};

/// Fails now and then: too little memory for a batch, or something worse.
class Trouble {
 public:
  void operator()(const std::vector<Id>& segments) {
    const int dice = std::atomic_fetch_add(&count_, 1) % 37;
    if (dice % 5 == 0 && segments.size() > 2) throw std::bad_alloc();
    if (dice == 11) throw std::runtime_error("injected");
  }

 private:
  std::atomic<int> count_{0};
};

}  // namespace

TEST(Stress, of_a_leader_whose_workers_fail_loses_and_mistakes_nothing) {
  const Stressed stressed;
  Trouble at_launch, at_finish;
  std::vector<std::unique_ptr<detail::BatchWorker>> workers;
  for (int i = 0; i < 3; ++i) {
    workers.push_back(
        std::make_unique<Interrupted>(stressed.mesh, std::ref(at_launch), [&](const std::vector<Id>& segments) {
          if (segments.size() == 1) at_finish({});
        }));
  }
  detail::LeaderParameters parameters;
  parameters.relations = Relation::VV;
  parameters.arena_words = 512;
  parameters.host_budget = 1 << 13;
  parameters.segments_per_request = 5;
  detail::Leader leader(stressed.mesh, parameters, std::move(workers));
  std::atomic<long> right{0}, wrong{0}, failed{0};
  const int rounds = 300 * times();
  on_threads(consumers, [&](int consumer) {
    std::mt19937 random(consumer);
    ConsumerStatistics statistics;
    for (int i = 0; i < rounds; ++i) {
      const Id segment = static_cast<Id>(random() % stressed.mesh.segments());
      try {
        const detail::Lease lease = leader.acquire(segment, false, statistics);
        stressed.is_right(segment, lease) ? ++right : ++wrong;
      } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "computing VV failed: injected");
        ++failed;
      }
    }
  });
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(right + failed, consumers * rounds) << "each request is answered, one way or the other";
  EXPECT_GT(failed, 0);
  EXPECT_GT(leader.statistics().batches_split, 0);
}

TEST(Stress, of_consumers_and_sweeps_with_budgets_that_hold_next_to_nothing) {
  const Stressed stressed;
  const RelationSet relations = star_relations;
  for (NamedWay way : ways()) {
    // Helpers need a little to help at all.
    way.options.host_memory = way.options.way == Way::helpers ? 1 << 24 : 1 << 13;
    const auto runtime = way.make(stressed.mesh, relations);
    std::atomic<long> wrong{0};
    std::atomic<int> swept{0};
    const int rounds = 20 * times();
    on_threads(consumers, [&](int number) {
      const auto consumer = runtime->consumer();
      std::mt19937 random(number);
      for (int i = 0; i < rounds; ++i) {
        const Id v = static_cast<Id>(random() % stressed.mesh.vertices());
        const Row vv = consumer->row(Relation::VV, v), vt = consumer->row(Relation::VT, v);
        wrong += !std::equal(vv.begin(), vv.end(), stressed.expected.vv[v].begin(), stressed.expected.vv[v].end());
        wrong += !std::equal(vt.begin(), vt.end(), stressed.expected.vt[v].begin(), stressed.expected.vt[v].end());
        if (i % 10 != number % 10) continue;
        SweepOptions sweep;
        sweep.threads = 1 + number % 3;
        try {
          std::atomic<int> visited{0};
          runtime->for_each_segment(relations, sweep, [&](int, const SegmentRows& rows) {
            wrong += !stressed.expected.match(rows, relations);
            if (number % 4 == 0 && ++visited == 40) throw std::runtime_error("enough");
          });
          ++swept;
        } catch (const std::runtime_error& error) {
          EXPECT_STREQ(error.what(), "enough");
        }
      }
    });
    EXPECT_EQ(wrong, 0) << way.name;
    EXPECT_EQ(swept, rounds / 10 * (consumers - consumers / 4)) << way.name;
  }
}

}  // namespace gale::test
