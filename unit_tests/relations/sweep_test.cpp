#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

#include <gale/runtime/sweep.hpp>

#include "support/with_threads.hpp"

namespace gale::test {

namespace {

/// What a sweep called: the segments of each consumer, in order.
std::vector<std::vector<Id>> swept(Id segments, const SweepOptions& options) {
  std::vector<std::vector<Id>> by_consumer(options.threads);
  detail::sweep(segments, options, [&](int consumer, Id segment) { by_consumer.at(consumer).push_back(segment); });
  return by_consumer;
}

}  // namespace

TEST(Sweep, visits_each_segment_once_ascending_for_each_consumer) {
  for (const int threads : {1, 2, 3, 16}) {
    for (const Id segments : {0, 1, 2, 15, 1000, 100000}) {
      std::vector<int> visits(segments, 0);
      for (const auto& list : swept(segments, with_threads(threads))) {
        EXPECT_TRUE(std::is_sorted(list.begin(), list.end()));
        for (const Id segment : list) ++visits.at(segment);
      }
      EXPECT_EQ(visits, std::vector<int>(segments, 1)) << threads << " threads";
    }
  }
}

TEST(Sweep, refuses_less_than_one_thread) {
  for (const int threads : {0, -2}) {
    try {
      detail::sweep(5, with_threads(threads), [](int, Id) { FAIL(); });
      ADD_FAILURE() << "accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.what(), "threads is " + std::to_string(threads) + ", not 1 to 1024");
    }
  }
}

TEST(Sweep, of_one_thread_ends_at_the_segment_that_throws) {
  Id visits = 0;
  const auto body = [&](int, Id segment) {
    ++visits;
    if (segment == 1234) throw std::runtime_error("segment 1234");
  };
  EXPECT_THROW(detail::sweep(100000, with_threads(1), body), std::runtime_error);
  EXPECT_EQ(visits, 1235);
}

TEST(Sweep, of_several_threads_ends_soon_after_one_has_thrown) {
  for (const int threads : {2, 4}) {
    std::atomic<bool> thrown{false};
    std::atomic<Id> visits{0};
    const auto body = [&](int, Id segment) {
      ++visits;
      if (segment == 0) {
        thrown = true;
        throw std::runtime_error("segment 0");
      }
      while (!thrown) std::this_thread::yield();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    };
    EXPECT_THROW(detail::sweep(2000, with_threads(threads), body), std::runtime_error);
    EXPECT_LT(visits, 1500) << "the others went on";
  }
}

TEST(SegmentCursor, deals_nothing_out_after_it_was_stopped) {
  detail::SegmentCursor cursor({0, 100000}, 2);
  EXPECT_EQ(cursor.take().begin, 0);
  EXPECT_GT(cursor.take().begin, 0);
  cursor.stop();
  const auto range = cursor.take();
  EXPECT_EQ(range.begin, range.end);
}

TEST(Sweep, tells_its_progress_on_the_calling_thread_up_to_the_end) {
  for (const int threads : {1, 3}) {
    const auto caller = std::this_thread::get_id();
    std::vector<Id> told;
    auto options = with_threads(threads);
    options.progress = [&](Id done, Id segments) {
      EXPECT_EQ(std::this_thread::get_id(), caller);
      EXPECT_EQ(segments, 5000);
      told.push_back(done);
    };
    swept(5000, options);
    ASSERT_FALSE(told.empty());
    EXPECT_EQ(told.back(), 5000);
    EXPECT_LE(told.size(), 101u);
    for (std::size_t i = 1; i < told.size(); ++i) EXPECT_LT(told[i - 1], told[i]);
  }
}

TEST(Sweep, ends_when_the_progress_callback_throws) {
  auto options = with_threads(2);
  options.progress = [](Id, Id) { throw std::runtime_error("enough"); };
  EXPECT_THROW(swept(5000, options), std::runtime_error);
}

}  // namespace gale::test
