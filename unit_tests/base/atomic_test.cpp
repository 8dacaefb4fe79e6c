#include <gtest/gtest.h>

#include <gale/base/atomic.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/threads.hpp>
#include <gale/base/transfer.hpp>
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

/// Sets each bit of so many bytes by itself.
template <class Space>
Array<const std::uint8_t, HostMemory> bytes_with_all_bits(const Space& space, Offset count) {
  const Array<std::uint8_t, MemoryOf<Space>> bytes("bytes", count);
  parallel_for(
      "set_bits", space, 8 * count,
      KOKKOS_LAMBDA(Offset i) { detail::atomic_or(&bytes(i % count), static_cast<std::uint8_t>(1 << i / count)); });
  return on_host(bytes);
}

template <class Space>
class AtomicOr : public testing::Test {};
using Spaces = testing::Types<HostThreads, WorkerSpace>;
TYPED_TEST_SUITE(AtomicOr, Spaces);

TYPED_TEST(AtomicOr, leaves_the_bytes_beside_one_as_they_are) {
  const auto bytes = bytes_with_all_bits(TypeParam(), 4096);
  for (Offset i = 0; i < 4096; ++i) ASSERT_EQ(bytes(i), 255) << i;
}

TEST(AtomicOrOfAByte, returns_what_was_there) {
  alignas(4) std::uint8_t bytes[] = {1, 2, 4, 8};
  EXPECT_EQ(detail::atomic_or(&bytes[2], 3), 4);
  EXPECT_EQ(bytes[1], 2);
  EXPECT_EQ(bytes[2], 7);
  EXPECT_EQ(bytes[3], 8);
}

}  // namespace

}  // namespace gale::test
