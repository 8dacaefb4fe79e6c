#include <atomic>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <gale/base/atomic.hpp>
#include <gale/base/threads.hpp>
#include <gale/base/types.hpp>

namespace gale::test {

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

TEST(AtomicAdd, loses_nothing_between_threads) {
  Offset sum = 0;
  on_threads(4, [&](int) {
    for (int i = 0; i < 10000; ++i) atomic_add(&sum, Offset(1));
  });
  EXPECT_EQ(sum, 40000);
}

}  // namespace gale::test
