#include <algorithm>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include <gale/base/bit_table.hpp>
#include <gale/base/transfer.hpp>

namespace gale::test {

namespace {

constexpr Offset bound = 1000;  // no multiple of 64

/// Inserts multiples of three many times, and notes whether it was new.
struct InsertThirds {
  detail::BitTable table;
  Array<char, WorkerMemory> are_new;
  bool again;

  KOKKOS_FUNCTION void operator()(Offset i) const {
    const Offset number = 3 * i % bound / 3 * 3;
    again ? table.insert_again(number) : void(are_new(i) = table.insert(number));
  }
};

struct ReadNumbers {
  detail::BitTable table;
  Array<char, WorkerMemory> are_there;

  KOKKOS_FUNCTION void operator()(Offset number) const { are_there(number) = table.has(number); }
};

void expect_thirds(const detail::BitTable& table) {
  const WorkerSpace space;
  const ReadNumbers read{table, allocate<Array<char, WorkerMemory>>("there", bound)};
  parallel_for("read", space, bound, read);
  space.fence();
  const auto are_there = vector_of(read.are_there);
  const auto words = vector_of(table.words());
  ASSERT_EQ(words.size(), 16u);
  for (Offset n = 0; n < bound; ++n) {
    EXPECT_EQ(are_there[n] != 0, n % 3 == 0) << n;
    EXPECT_EQ(words[n / 64] >> (n % 64) & 1, std::uint64_t(n % 3 == 0)) << n;
  }
  EXPECT_EQ(words.back() >> (bound % 64), 0u);
}

}  // namespace

TEST(BitTable, has_what_was_inserted_each_once) {
  const WorkerSpace space;
  constexpr Offset insertions = 20000;
  for (const bool again : {false, true}) {
    const detail::BitTable table("table", space, bound);
    const InsertThirds insert{table, allocate<Array<char, WorkerMemory>>("new", insertions), again};
    parallel_for("insert", space, insertions, insert);
    space.fence();
    expect_thirds(table);
    const auto are_new = vector_of(insert.are_new);
    if (!again) EXPECT_EQ(std::count(are_new.begin(), are_new.end(), 1), (bound + 2) / 3);
  }
}

}  // namespace gale::test
