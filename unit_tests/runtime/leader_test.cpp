#include <future>
#include <new>
#include <thread>

#include <gtest/gtest.h>

#include <gale/base/error.hpp>
#include <gale/runtime/leaders/leader.hpp>

#include "runtime/interrupted.hpp"
#include "support/message_of.hpp"
#include "support/segmentations.hpp"

namespace gale::test {

namespace {

struct LedMesh {
  const InputMesh& input = mesh_named("holed_grid_9");
  Mesh mesh = encode(input, 7);
  ConsumerStatistics statistics;

  std::unique_ptr<detail::Leader> leader(Interrupted::Interruption at_launch, Interrupted::Interruption at_finish,
                                         Id per_request = 8, bool has_host = false) {
    std::vector<std::unique_ptr<detail::BatchWorker>> workers;
    for (int i = 0; i < 2; ++i) workers.push_back(std::make_unique<Interrupted>(mesh, at_launch, at_finish));
    detail::LeaderParameters parameters;
    parameters.relations = Relation::VV;
    parameters.arena_words = 4096;
    parameters.host_budget = 1 << 20;
    parameters.segments_per_request = per_request;
    if (has_host) {
      parameters.make_host_worker = [this] { return detail::make_host_worker(mesh, {Relation::VV, 0, 32}); };
    }
    return std::make_unique<detail::Leader>(mesh, parameters, std::move(workers));
  }
};

}  // namespace

TEST(Leader, hands_the_cause_of_a_failure_to_the_consumer_and_then_works_again) {
  LedMesh fixture;
  for (const bool at_launch : {true, false}) {
    std::atomic<bool> broken{true};
    const auto fail = [&](const std::vector<Id>&) {
      if (broken) throw std::runtime_error("the device fell off the bus");
    };
    const auto leader = at_launch ? fixture.leader(fail, {}) : fixture.leader({}, fail);
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(message_of([&] { leader->acquire(i, false, fixture.statistics); }),
                "computing VV failed: the device fell off the bus");
    }
    broken = false;
    EXPECT_TRUE(leader->acquire(0, false, fixture.statistics));
  }
}

TEST(Leader, hands_a_failure_to_all_who_wait) {
  LedMesh fixture;
  std::promise<void> all_wait;
  const auto ready = all_wait.get_future().share();
  const auto leader = fixture.leader({}, [&](const std::vector<Id>&) {
    ready.wait();
    throw std::runtime_error("no");
  });
  std::vector<std::thread> threads;
  std::atomic<int> told{0};
  for (int i = 0; i < 6; ++i) {
    threads.emplace_back([&] {
      ConsumerStatistics statistics;
      if (message_of([&] { leader->acquire(3, false, statistics); }) == "computing VV failed: no") ++told;
    });
  }
  all_wait.set_value();
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(told, 6);
}

TEST(Leader, halves_a_batch_that_is_too_big_for_memory) {
  LedMesh fixture;
  const auto leader = fixture.leader(
      [](const std::vector<Id>& segments) {
        if (segments.size() > 3) throw std::bad_alloc();
      },
      {}, 16);
  EXPECT_TRUE(leader->acquire(0, false, fixture.statistics));
  EXPECT_GE(leader->statistics().batches_split, 2);
}

TEST(Leader, says_when_one_segment_is_too_big_for_memory) {
  LedMesh fixture;
  const auto leader = fixture.leader([](const std::vector<Id>&) { throw std::bad_alloc(); }, {});
  EXPECT_EQ(message_of([&] { leader->acquire(5, false, fixture.statistics); }),
            "computing VV failed: std::bad_alloc, for one segment");
}

TEST(Leader, has_the_host_compute_a_segment_that_is_too_big_for_memory) {
  LedMesh fixture;
  const auto leader = fixture.leader(
      [](const std::vector<Id>& segments) {
        if (segments.front() % 2 == 1 || segments.size() > 1) throw std::bad_alloc();
      },
      {}, 4, true);
  for (Id s = 0; s < 12; ++s) EXPECT_TRUE(leader->acquire(s, false, fixture.statistics)) << s;
  EXPECT_GE(leader->statistics().segments_on_host, 6);
}

TEST(Leader, lets_consumers_that_want_one_segment_share_one_computation) {
  LedMesh fixture;
  std::promise<void> all_wait;
  const auto ready = all_wait.get_future().share();
  const auto leader = fixture.leader(
      {}, [&](const std::vector<Id>&) { ready.wait(); }, 1);
  std::vector<std::thread> threads;
  for (int i = 0; i < 6; ++i) {
    threads.emplace_back([&] {
      ConsumerStatistics statistics;
      EXPECT_TRUE(leader->acquire(3, false, statistics));
    });
  }
  all_wait.set_value();
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(leader->statistics().segments_computed, 1);
}

TEST(Leader, makes_one_batch_of_all_requests_that_wait) {
  LedMesh fixture;
  std::promise<void> begun, go_on;
  const auto may_go_on = go_on.get_future().share();
  std::atomic<int> finished{0};
  const auto leader = fixture.leader(
      {},
      [&](const std::vector<Id>&) {
        if (finished++ == 0) begun.set_value();
        may_go_on.wait();
      },
      1);
  std::vector<std::thread> threads;
  for (int i = 0; i < 9; ++i) {
    threads.emplace_back([&, i] {
      ConsumerStatistics statistics;
      EXPECT_TRUE(leader->acquire(3 * i, false, statistics));
    });
    if (i == 0) begun.get_future().wait();
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  go_on.set_value();
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(leader->statistics().batches, 2);
}

TEST(Leader, that_ends_fails_those_who_still_wait) {
  LedMesh fixture;
  std::promise<void> begun, go_on;
  const auto may_go_on = go_on.get_future().share();
  std::atomic<int> launched{0};
  auto leader = fixture.leader(
      {},
      [&](const std::vector<Id>&) {
        if (launched++ == 0) begun.set_value();
        may_go_on.wait();
      },
      1);
  // One request is under way when the leader ends, another is on the queue.
  detail::Leader& late = *leader;
  std::string messages[2];
  std::vector<std::thread> threads;
  for (int i = 0; i < 2; ++i) {
    threads.emplace_back([&, i] {
      ConsumerStatistics statistics;
      messages[i] = message_of([&] { late.acquire(9 * i, false, statistics); });
    });
    if (i == 0) begun.get_future().wait();
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  threads.emplace_back([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    go_on.set_value();
  });
  leader.reset();
  for (auto& thread : threads) thread.join();
  for (const auto& message : messages) EXPECT_EQ(message, "the runtime ended while a consumer waited for VV");
}

}  // namespace gale::test
