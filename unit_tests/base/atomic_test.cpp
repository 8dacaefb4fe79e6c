#include <gtest/gtest.h>

#include <gale/base/atomic.hpp>
#include <gale/base/threads.hpp>
#include <gale/base/types.hpp>

namespace gale::test {

namespace {

template <class T>
class Atomics : public testing::Test {};
using Types = testing::Types<std::int32_t, std::uint32_t, std::int64_t, std::uint64_t, float, double>;
TYPED_TEST_SUITE(Atomics, Types);

/// Four threads do the same at once, each so often.
constexpr int threads = 4, times = 100000;

TYPED_TEST(Atomics, lose_nothing) {
  TypeParam sum = 0, least = times, most = 0, by_hand = 0;
  on_threads(threads, [&](int) {
    for (int i = 0; i < times; ++i) {
      atomic_add(&sum, 1);
      atomic_min(&least, times - i);
      atomic_max(&most, i);
      TypeParam there = atomic_read(&by_hand), before = 0;
      while ((before = atomic_compare_exchange(&by_hand, there, there + 1)) != there) there = before;
    }
  });
  EXPECT_EQ(sum, TypeParam(threads * times));
  EXPECT_EQ(by_hand, TypeParam(threads * times));
  EXPECT_EQ(least, TypeParam(1));
  EXPECT_EQ(most, TypeParam(times - 1));
}

TYPED_TEST(Atomics, return_what_was_there) {
  TypeParam value = 5;
  EXPECT_EQ(atomic_add(&value, 2), TypeParam(5));
  EXPECT_EQ(atomic_max(&value, 6), TypeParam(7));
  EXPECT_EQ(atomic_max(&value, 9), TypeParam(7));
  EXPECT_EQ(atomic_min(&value, 8), TypeParam(9));
  EXPECT_EQ(atomic_compare_exchange(&value, 7, 1), TypeParam(8));
  EXPECT_EQ(atomic_exchange(&value, 3), TypeParam(8));
  atomic_write(&value, 4);
  EXPECT_EQ(atomic_read(&value), TypeParam(4));
}

}  // namespace

}  // namespace gale::test
