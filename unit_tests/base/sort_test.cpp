#include <algorithm>
#include <functional>
#include <numeric>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include <gale/base/rank_rows.hpp>
#include <gale/base/sort.hpp>

#include "support/arrays.hpp"

namespace gale::test {

namespace {

using Keys = std::vector<std::uint64_t>;

/// Sorts as GALE does, and as the standard library does, with each key's first place as its value.
void expect_stable_sort(const Keys& keys) {
  std::vector<Id> order(keys.size());
  std::iota(order.begin(), order.end(), 0);
  const auto sorted_keys = to_worker(keys);
  const auto values = to_worker(order);
  stable_sort_by_key(WorkerSpace(), sorted_keys, values);
  std::stable_sort(order.begin(), order.end(), [&](Id a, Id b) { return keys[a] < keys[b]; });
  EXPECT_EQ(to_vector(values), order);
  Keys expected = keys;
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(to_vector(sorted_keys), expected);
}

Keys random_keys(std::size_t count, std::uint64_t mask) {
  std::mt19937_64 random(1);
  Keys keys(count);
  for (auto& key : keys) key = random() & mask;
  return keys;
}

void expect_sorted_rows(const std::vector<Offset>& begin, const std::vector<Id>& values) {
  const auto sorted = to_worker(values);
  sort_rows(WorkerSpace(), "test_sort", Csr<Id, WorkerMemory>{to_worker(begin), sorted});
  std::vector<Id> expected = values;
  for (std::size_t row = 0; row + 1 < begin.size(); ++row) {
    std::sort(expected.begin() + begin[row], expected.begin() + begin[row + 1]);
  }
  EXPECT_EQ(to_vector(sorted), expected);
}

}  // namespace

TEST(ParallelSort, is_that_of_the_standard_library) {
  const int before = host_threads();
  for (const int threads : {1, 2, 3, 5, 7, 16}) {
    set_host_threads(threads);
    for (const std::size_t count : {0, 1, 4095, 8192, 12289, 70000}) {
      for (const std::uint64_t mask : {~std::uint64_t(0), std::uint64_t(255)}) {
        Keys sorted = random_keys(count, mask), expected = sorted;
        std::sort(expected.begin(), expected.end(), std::greater<>());
        parallel_sort("test_sort", sorted.begin(), sorted.end(), std::greater<>());
        EXPECT_EQ(sorted, expected) << count << " keys, " << threads << " threads";
      }
    }
  }
  set_host_threads(before);
}

TEST(MergeRuns, keeps_the_order_of_equal_entries_whatever_the_threads) {
  using Entry = std::pair<std::uint64_t, int>;  // a key and its place
  const auto is_less = [](const Entry& a, const Entry& b) { return a.first < b.first; };
  const int before = host_threads();
  for (const int threads : {1, 2, 5, 16}) {
    set_host_threads(threads);
    for (const std::vector<int>& lengths :
         {std::vector<int>{50000, 0, 70000}, {1, 90000}, {90000, 1}, {60000, 60000}}) {
      for (const std::uint64_t mask : {std::uint64_t(0), std::uint64_t(7), ~std::uint64_t(0)}) {
        std::vector<Entry> merged;
        std::vector<Offset> begin(1, 0);
        for (const int length : lengths) {
          Keys keys = random_keys(length, mask);
          std::sort(keys.begin(), keys.end());
          for (const auto key : keys) merged.emplace_back(key, static_cast<int>(merged.size()));
          begin.push_back(static_cast<Offset>(merged.size()));
        }
        std::vector<Entry> expected = merged;
        std::stable_sort(expected.begin(), expected.end(), is_less);
        merge_runs(merged.begin(), begin, is_less);
        EXPECT_EQ(merged, expected) << threads << " threads";
      }
    }
  }
  set_host_threads(before);
}

TEST(StableSortByKey, of_nothing_and_of_one) {
  expect_stable_sort({});
  expect_stable_sort({7});
}

TEST(StableSortByKey, of_all_bits) { expect_stable_sort(random_keys(30000, ~std::uint64_t(0))); }

TEST(StableSortByKey, keeps_the_order_of_equal_keys) { expect_stable_sort(random_keys(30000, 15)); }

TEST(StableSortByKey, of_equal_keys_moves_nothing) { expect_stable_sort(Keys(10000, 42)); }

TEST(StableSortByKey, of_equal_keys_but_one) {
  for (const std::uint64_t odd : {std::uint64_t(0), std::uint64_t(43), ~std::uint64_t(0)}) {
    Keys keys(1000, 42);
    keys[500] = odd;
    expect_stable_sort(keys);
  }
}

TEST(StableSortByKey, of_one_digit_anywhere) {
  for (int shift = 0; shift < 64; ++shift) expect_stable_sort(random_keys(300, std::uint64_t(7) << shift));
}

TEST(StableSortByKey, treats_keys_as_unsigned) {
  expect_stable_sort({~std::uint64_t(0), 0, std::uint64_t(1) << 63, 1});
}

/// Keys of rows, and what stands beside them.
struct KeyedEntries {
  struct Entry {
    int key, place;
    bool operator<(const Entry& other) const { return key < other.key; }
  };
  Entry* all;

  Entry load(Offset i) const { return all[i]; }
  void store(Offset i, const Entry& entry) const { all[i] = entry; }
};

TEST(RankRows, puts_rows_in_order_together_one_by_one_or_by_a_thread) {
  std::mt19937 random(5);
  constexpr int capacity = 40;
  std::vector<Offset> begin = {0};
  std::vector<KeyedEntries::Entry> entries;
  for (const int length : {3, 0, 7, 1, 12, 20, 39, 40, 41, 2, 300, 5, 0, 17, 40, 40, 0})
    begin.push_back(begin.back() + length);
  for (int i = 0; i < begin.back(); ++i) entries.push_back({static_cast<int>(random() % 50), i});
  const auto rows = static_cast<Offset>(begin.size()) - 1;
  for (const int rows_of_team : {1, 4, 100}) {
    auto ranked = entries, expected = entries;
    detail::rank_rows(
        "test_rank", HostExecutionSpace(),
        detail::RankRows<Offset, KeyedEntries>{{ranked.data()}, begin.data(), rows, rows_of_team, capacity});
    for (Offset row = 0; row < rows; ++row) {
      const auto first = expected.begin() + begin[row], last = expected.begin() + begin[row + 1];
      std::stable_sort(first, last);
      const bool stands_alone = begin[row + 1] - begin[row] > capacity;
      for (Offset i = begin[row]; i < begin[row + 1]; ++i) {
        EXPECT_EQ(ranked[i].key, expected[i].key) << "row " << row;
        if (!stands_alone) EXPECT_EQ(ranked[i].place, expected[i].place) << "row " << row;
      }
    }
  }
}

TEST(SortRows, of_nothing) {
  expect_sorted_rows({0}, {});
  expect_sorted_rows({0, 0, 0}, {});
}

TEST(SortRows, each_by_itself) { expect_sorted_rows({0, 3, 3, 4, 8}, {5, 1, 3, 0, 9, 2, 4, 8}); }

TEST(SortRows, of_any_length) {
  std::mt19937 random(9);
  std::vector<Offset> begin = {0};
  std::vector<Id> values;
  for (const Offset length : {0, 1, 2, 3, 31, 32, 33, 64, 500, 5000, 0, 40000, 1})
    begin.push_back(begin.back() + length);
  for (Offset i = 0; i < begin.back(); ++i) values.push_back(static_cast<Id>(random() % 1000));
  expect_sorted_rows(begin, values);
}

TEST(SortRows, of_many) {
  std::mt19937 random(9);
  std::vector<Offset> begin = {0};
  for (int row = 0; row < 20000; ++row) begin.push_back(begin.back() + random() % 9);
  std::vector<Id> values;
  for (Offset i = 0; i < begin.back(); ++i) values.push_back(static_cast<Id>(random()));
  expect_sorted_rows(begin, values);
}

}  // namespace gale::test
