#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <gale/ttk/first_met.hpp>

namespace gale::test {

namespace {

/// Has each cell meet places by the bits of met[cell]; numbers must be those of a list that is filled in that order.
void expect_numbers(const std::vector<unsigned>& met) {
  std::vector<std::pair<Id, int>> list;
  ttk::FirstMet first_met(static_cast<Id>(met.size()));
  for (auto cell = static_cast<Id>(met.size()); cell-- > 0;) {
    for (int place = 6; place-- > 0;) {
      if ((met[cell] >> place & 1) != 0) first_met.meet(cell, place);
    }
  }
  for (Id cell = 0; cell < static_cast<Id>(met.size()); ++cell) {
    for (int place = 0; place < 6; ++place) {
      if ((met[cell] >> place & 1) != 0) list.emplace_back(cell, place);
    }
  }
  const Id count = static_cast<Id>(list.size());
  first_met.count(count);
  for (Id i = 0; i < count; ++i) {
    const auto [cell, place] = first_met[i];
    ASSERT_EQ(std::pair(cell, place), list[i]) << "of " << count;
    ASSERT_EQ(first_met.number(cell, place), i);
  }
}

TEST(TtkFirstMet, numbers_the_edges_of_one_cell) { expect_numbers({63}); }

TEST(TtkFirstMet, numbers_as_one_meets_them) {
  std::mt19937 random(7);
  for (const int cells : {7, 8, 9, 64, 1000}) {
    std::vector<unsigned> met(cells);
    for (unsigned& bits : met) bits = random() % 64;
    expect_numbers(met);
  }
}

TEST(TtkFirstMet, numbers_across_long_runs_of_cells_that_meet_nothing_new) {
  std::vector<unsigned> met(100000);
  for (const int cell : {0, 1, 40000, 40001, 40008, 99999}) met[cell] = 63;
  for (int cell = 70000; cell < 70003; ++cell) met[cell] = 5;
  expect_numbers(met);
}

TEST(TtkFirstMet, numbers_a_multiple_of_the_sampled_ones) { expect_numbers(std::vector<unsigned>(24, 15)); }

}  // namespace

}  // namespace gale::test
