#include <atomic>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <gale/base/atomic.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort.hpp>
#include <gale/base/stop.hpp>
#include <gale/base/threads.hpp>
#include <gale/runtime/sweep.hpp>

namespace gale::test {

namespace {

constexpr Offset n = 1 << 22;

/// Asks to stop at its first call, and counts calls.
class Asking {
 public:
  explicit Asking(StopRequest& request) : request_(request) {}

  void operator()() const {
    request_.stop();
    atomic_add(&calls, Offset(1));
  }

  mutable Offset calls = 0;

 private:
  StopRequest& request_;
};

/// Expects that `loop(ask)`, which calls ask() in each of n steps, stops after some of them.
template <class Loop>
void expect_stops(const char* name, const Loop& loop) {
  for (const int threads : {1, 3}) {
    StopRequest request;
    const Asking ask(request);
    const ThreadLimit limit(threads);
    const StopScope stoppable(&request);
    EXPECT_THROW(loop([&] { ask(); }, threads), Stopped) << name;
    EXPECT_LT(ask.calls, n / 2) << name;
  }
}

}  // namespace

TEST(Stop, ends_every_kind_of_loop) {
  const HostExecutionSpace space;
  const Array<Offset, HostMemory> begin("begin", n + 1);
  expect_stops("parallel_for", [&](const auto& ask, int) { parallel_for("test", space, n, [&](Offset) { ask(); }); });
  expect_stops("exclusive_scan", [&](const auto& ask, int) {
    exclusive_scan("test", space, n, begin, [&](Offset) { return ask(), 1; });
  });
  expect_stops("reduce_min",
               [&](const auto& ask, int) { reduce_min("test", space, n, 0, [&](Offset) { return ask(), 1; }); });
  expect_stops("reduce_sum",
               [&](const auto& ask, int) { reduce_sum("test", space, n, [&](Offset) { return ask(), 1; }); });
  expect_stops("in_turns",
               [&](const auto& ask, int threads) { in_turns(threads, n, [&](int, std::int64_t) { ask(); }); });
  expect_stops("in_turns_with_more", [&](const auto& ask, int threads) {
    detail::in_turns_with_more(threads, std::vector<int>(n), [&](int, int, const auto&) { ask(); });
  });
  expect_stops("sweep", [&](const auto& ask, int threads) {
    SweepOptions options;
    options.threads = threads;
    detail::sweep(n, options, [&](int, Id) { ask(); });
  });
  expect_stops("parallel_sort", [&](const auto& ask, int) {
    std::vector<int> values(n / 8);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<int>(i * 7919 % values.size());
    parallel_sort("test", values.begin(), values.end(), [&](int a, int b) { return ask(), a < b; });
  });
}

TEST(Stop, ends_a_radix_sort) {
  const Array<std::uint64_t, HostMemory> keys("keys", 1 << 20);
  const Array<Id, HostMemory> values("values", 1 << 20);
  for (std::size_t i = 0; i < keys.extent(0); ++i) keys(i) = i * 0x9E3779B97F4A7C15u;
  StopRequest request;
  request.stop();
  const StopScope stoppable(&request);
  EXPECT_THROW(stable_sort_by_key(HostExecutionSpace(), keys, values), Stopped);
}

TEST(Stop, is_for_the_scope_alone) {
  StopRequest request;
  request.stop();
  {
    const StopScope stoppable(&request);
    EXPECT_THROW(detail::stop_if_asked(), Stopped);
    {
      const StopScope not_here(nullptr);
      EXPECT_NO_THROW(detail::stop_if_asked());
    }
    EXPECT_THROW(detail::stop_if_asked(), Stopped);
    std::thread([] { EXPECT_NO_THROW(detail::stop_if_asked()); }).join();
  }
  EXPECT_NO_THROW(detail::stop_if_asked());
}

TEST(Stop, ends_waiting_for_a_mutex) {
  std::mutex mutex;
  const std::lock_guard<std::mutex> held(mutex);
  std::thread([&] {
    StopRequest request;
    const StopScope stoppable(&request);
    std::thread asking([&] { request.stop(); });
    EXPECT_THROW(detail::lock_or_stop(mutex), Stopped);
    asking.join();
  }).join();
}

}  // namespace gale::test
