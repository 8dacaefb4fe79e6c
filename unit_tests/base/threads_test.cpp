#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <gale/base/atomic.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/threads.hpp>
#include <gale/base/types.hpp>

namespace gale::test {

namespace {

/// How many threads a loop over a million numbers runs on.
std::size_t threads_of_a_loop() {
  std::mutex mutex;
  std::set<std::thread::id> threads;
  detail::for_parts("test", 1 << 20, detail::threads_for(1 << 20), [&](int, Offset, Offset) {
    const std::lock_guard<std::mutex> lock(mutex);
    threads.insert(std::this_thread::get_id());
  });
  return threads.size();
}

template <class Body>
void on_another_thread(const Body& body) {
  std::thread(body).join();
}

/// What the process may use for the length of a test.
class Threads {
 public:
  explicit Threads(int count) : before_(host_threads()) { set_host_threads(count); }
  ~Threads() { set_host_threads(before_); }

 private:
  int before_;
};

}  // namespace

TEST(OnThreads, calls_each_number_once) {
  for (const int count : {1, 2, 3, 16}) {
    std::vector<std::atomic<int>> calls(count);
    on_threads(count, [&](int i) { ++calls.at(i); });
    for (const auto& number : calls) EXPECT_EQ(number, 1) << "of " << count;
  }
}

TEST(OnThreads, throws_what_a_body_threw_after_all_have_ended) {
  for (const int bad : {0, 1, 3}) {
    std::atomic<int> ended{0};
    const auto run = [&] {
      on_threads(4, [&](int i) {
        if (i == bad) throw std::runtime_error("number " + std::to_string(i));
        ++ended;
      });
    };
    try {
      run();
      ADD_FAILURE() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(error.what(), "number " + std::to_string(bad));
    }
    EXPECT_EQ(ended, 3);
  }
}

TEST(OnThreads, lets_bodies_loop_on_their_own_thread) {
  std::atomic<int> wrong{0};
  on_threads(3, [&](int) { wrong += host_threads() != 1 || threads_of_a_loop() != 1; });
  EXPECT_EQ(wrong, 0);
}

TEST(InTurnsWithMore, calls_each_item_once_and_what_it_adds) {
  for (const int count : {1, 2, 16}) {
    std::vector<std::atomic<int>> calls(127);
    detail::in_turns_with_more(count, std::vector<int>{0}, [&](int thread, int item, auto& add) {
      EXPECT_LT(thread, count);
      ++calls.at(item);
      for (const int more : {2 * item + 1, 2 * item + 2}) {
        if (more < 127) add(more);
      }
    });
    for (const auto& number : calls) EXPECT_EQ(number, 1) << "of " << count;
  }
}

TEST(InTurnsWithMore, ends_where_a_body_throws) {
  for (const int count : {1, 4}) {
    std::atomic<int> calls{0};
    const auto run = [&] {
      detail::in_turns_with_more(count, std::vector<int>{0}, [&](int, int item, auto& add) {
        ++calls;
        if (item == 9) throw std::runtime_error("item 9");
        add(item + 1);
      });
    };
    EXPECT_THROW(run(), std::runtime_error);
    EXPECT_EQ(calls, 10);
  }
}

TEST(InTurnsWithMore, begins_nothing_that_is_added_after_a_body_threw) {
  for (int run = 0; run < 200; ++run) {
    const auto add_for_ever = [](int, int item, auto& add) {
      add(item + 1);
      if (item == 9) throw std::runtime_error("item 9");
    };
    EXPECT_THROW(detail::in_turns_with_more(4, std::vector<int>{0}, add_for_ever), std::runtime_error);
  }
}

TEST(InTurnsWithMore, says_where_threads_wait_for_more) {
  detail::in_turns_with_more(1, std::vector<int>{0, 1}, [](int, int, auto& more) { EXPECT_FALSE(more.are_short()); });
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  std::atomic<int> calls{0};
  detail::in_turns_with_more(2, std::vector<int>{0}, [&](int, int item, auto& more) {
    ++calls;
    if (item > 0) return;
    while (!more.are_short() && std::chrono::steady_clock::now() < end) std::this_thread::yield();
    EXPECT_TRUE(more.are_short()) << "the other thread has nothing to do";
    more(1);
  });
  EXPECT_EQ(calls, 2);
}

TEST(HostThreads, are_as_many_as_were_set_on_any_thread) {
  const Threads five(5);
  EXPECT_EQ(host_threads(), 5);
  EXPECT_EQ(threads_of_a_loop(), 5u);
  on_another_thread([] {
    EXPECT_EQ(host_threads(), 5);
    EXPECT_EQ(threads_of_a_loop(), 5u);
  });
  set_host_threads(0);
  EXPECT_EQ(host_threads(), 1) << "at least";
}

TEST(ThreadLimit, bounds_the_loops_of_its_thread_alone) {
  const Threads four(4);
  {
    const ThreadLimit limit(2);
    EXPECT_EQ(host_threads(), 2);
    EXPECT_EQ(threads_of_a_loop(), 2u);
    on_another_thread([] { EXPECT_EQ(threads_of_a_loop(), 4u); });
  }
  EXPECT_EQ(threads_of_a_loop(), 4u);
}

TEST(ThreadLimit, of_several_is_the_least) {
  const Threads four(4);
  const ThreadLimit three(3);
  {
    const ThreadLimit many(7);
    EXPECT_EQ(host_threads(), 3);
    const ThreadLimit none(0);
    EXPECT_EQ(host_threads(), 1) << "at least";
  }
  EXPECT_EQ(host_threads(), 3);
}

TEST(Meanwhile, runs_beside_what_is_here_within_the_same_limits) {
  for (const int threads : {1, 4}) {
    const Threads some(threads);
    const ThreadLimit limit(2);
    const std::thread::id caller = std::this_thread::get_id();
    std::thread::id beside, here;
    std::size_t there = 0;
    detail::meanwhile(
        [&] {
          beside = std::this_thread::get_id();
          there = threads_of_a_loop();
        },
        [&] { here = std::this_thread::get_id(); });
    EXPECT_EQ(here, caller);
    EXPECT_EQ(beside == caller, threads == 1);
    EXPECT_EQ(there, threads == 1 ? 1u : 2u);
  }
}

TEST(Meanwhile, throws_what_either_threw_after_both_have_ended) {
  const Threads two(2);
  const auto fail = [](const char* why) { throw std::runtime_error(why); };
  const auto why = [&](const auto& beside, const auto& here) {
    try {
      detail::meanwhile(beside, here);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  bool has_ended = false;
  const auto end_late = [&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    has_ended = true;
  };
  EXPECT_EQ(why([&] { fail("beside"); }, end_late), "beside");
  EXPECT_TRUE(std::exchange(has_ended, false));
  EXPECT_EQ(why(end_late, [&] { fail("here"); }), "here");
  EXPECT_TRUE(has_ended);
  EXPECT_EQ(why([&] { fail("beside"); }, [&] { fail("here"); }), "here");
}

TEST(CpuQuota, of_version_2_is_a_quota_and_a_period) {
  EXPECT_EQ(detail::cpus_of_quota("200000 100000\n"), 2);
  EXPECT_EQ(detail::cpus_of_quota("150000 100000\n"), 2) << "rounded up";
  EXPECT_EQ(detail::cpus_of_quota("1000 100000\n"), 1);
  EXPECT_EQ(detail::cpus_of_quota("100001 100000"), 2);
  EXPECT_EQ(detail::cpus_of_quota("9000000000000000000 1"), 2147483647);
}

TEST(CpuQuota, of_version_1_is_in_two_files) {
  EXPECT_EQ(detail::cpus_of_quota("350000\n", "100000\n"), 4);
  EXPECT_EQ(detail::cpus_of_quota("50000\n", "100000\n"), 1);
  EXPECT_EQ(detail::cpus_of_quota("-1\n", "100000\n"), 0) << "none";
}

TEST(CpuQuota, is_none_where_the_text_says_so_or_nothing_that_is_understood) {
  for (const char* text : {"max 100000\n", "", "max", "200000", "200000 0", "0 100000", "-1 100000", "many few"}) {
    EXPECT_EQ(detail::cpus_of_quota(text), 0) << text;
  }
  EXPECT_EQ(detail::cpus_of_quota("", ""), 0);
}

TEST(AvailableCores, are_one_or_more_and_no_more_than_the_machine_has) {
  EXPECT_GE(detail::available_cores(), 1);
  EXPECT_LE(detail::available_cores(), static_cast<int>(std::thread::hardware_concurrency()));
}

TEST(AtomicAdd, loses_nothing_between_threads) {
  Offset sum = 0;
  on_threads(4, [&](int) {
    for (int i = 0; i < 10000; ++i) atomic_add(&sum, Offset(1));
  });
  EXPECT_EQ(sum, 40000);
}

}  // namespace gale::test
