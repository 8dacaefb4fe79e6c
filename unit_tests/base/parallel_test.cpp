#include <atomic>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <gale/base/parallel.hpp>
#include <gale/base/types.hpp>

#include "support/arrays.hpp"

namespace gale::test {

namespace {

/// Around the sizes at which loops begin to use several threads, and beyond.
constexpr Offset sizes[] = {0, 1, 2, 4095, 4096, 4097, 8192, 100003};

template <class T>
Array<T, WorkerMemory> scan_squares(Offset n, T* total) {
  const auto begin = allocate<Array<T, WorkerMemory>>("begin", n + 1);
  *total = exclusive_scan(
      "test_scan", WorkerSpace(), n, begin, KOKKOS_LAMBDA(Offset i) { return T(i % 7 * (i % 7)); });
  return begin;
}

template <class T>
Array<T, WorkerMemory> scan_in_place(const std::vector<T>& counts, T* total) {
  auto values = counts;
  values.push_back(T(77));
  const auto begin = to_worker(values);
  *total = exclusive_scan(
      "test_scan", WorkerSpace(), counts.size(), begin, KOKKOS_LAMBDA(Offset i) { return begin(i); });
  return begin;
}

template <class T>
T least(const std::vector<T>& values, T initial) {
  const auto array = to_worker(values);
  return reduce_min(
      "test_min", WorkerSpace(), values.size(), initial, KOKKOS_LAMBDA(Offset i) { return array(i); });
}

Array<Id, WorkerMemory> doubled(Offset n) {
  const Array<Id, WorkerMemory> values("values", n);
  parallel_for(
      "test_for", WorkerSpace(), n, KOKKOS_LAMBDA(Offset i) { values(i) += static_cast<Id>(2 * i); });
  return values;
}

}  // namespace

TEST(Unwritten, vectors_have_their_entries_and_grow) {
  for (const std::size_t count : {std::size_t(0), std::size_t(1), std::size_t(100000)}) {
    EXPECT_EQ(detail::zeros<Id>(count), std::vector<Id>(count, 0));
    auto all = detail::unwritten<Id>(count);
    ASSERT_EQ(all.size(), count);
    std::fill(all.begin(), all.end(), 7);
    all.push_back(8);
    EXPECT_EQ(all.size(), count + 1);
    EXPECT_EQ(all.back(), 8);
    EXPECT_EQ(all.front(), count == 0 ? 8 : 7);
  }
}

TEST(ParallelFor, calls_the_body_once_for_each_index) {
  for (const Offset n : sizes) {
    const auto values = to_vector(doubled(n));
    for (Offset i = 0; i < n; ++i) ASSERT_EQ(values[i], 2 * i);
  }
}

TEST(ParallelFor, on_the_host_uses_threads_but_each_index_once) {
  constexpr Offset n = 50000;
  std::vector<std::atomic<int>> calls(n);
  parallel_for("test_for", HostExecutionSpace(), n, [&](Offset i) { ++calls[i]; });
  for (const auto& count : calls) ASSERT_EQ(count, 1);
}

TEST(ExclusiveScan, is_the_sum_of_those_before) {
  for (const Offset n : sizes) {
    Offset total = -1;
    const auto begin = to_vector(scan_squares<Offset>(n, &total));
    Offset sum = 0;
    for (Offset i = 0; i < n; ++i) {
      ASSERT_EQ(begin[i], sum) << "of " << n << " at " << i;
      sum += i % 7 * (i % 7);
    }
    EXPECT_EQ(begin[n], sum);
    EXPECT_EQ(total, sum);
  }
}

TEST(ExclusiveScan, may_replace_the_counts_that_it_reads) {
  for (const Offset n : sizes) {
    std::mt19937 random(5);
    std::vector<Id> counts(n);
    for (Id& count : counts) count = static_cast<Id>(random() % 5);
    Id total = -1;
    const auto begin = to_vector(scan_in_place(counts, &total));
    Id sum = 0;
    for (Offset i = 0; i < n; ++i) {
      ASSERT_EQ(begin[i], sum) << "of " << n << " at " << i;
      sum += counts[i];
    }
    EXPECT_EQ(begin[n], sum);
    EXPECT_EQ(total, sum);
  }
}

TEST(ExclusiveScan, counts_beyond_32_bits) {
  Offset total = 0;
  const auto begin = to_vector(scan_in_place(std::vector<Offset>(3, Offset(1) << 31), &total));
  EXPECT_EQ(total, Offset(3) << 31);
  EXPECT_EQ(begin[2], Offset(2) << 31);
}

TEST(ReduceMin, of_nothing_is_the_initial_value) { EXPECT_EQ(least<Offset>({}, 5), 5); }

TEST(ReduceMin, is_the_initial_value_if_that_is_less) { EXPECT_EQ(least<Offset>({7, 9}, 5), 5); }

TEST(ReduceMin, finds_the_least_anywhere) {
  for (const std::size_t at : {0, 1, 4095, 4096, 19999}) {
    std::vector<double> values(20000, 3.5);
    values[at] = -2.25;
    EXPECT_EQ(least(values, std::numeric_limits<double>::infinity()), -2.25) << "at " << at;
  }
}

}  // namespace gale::test
