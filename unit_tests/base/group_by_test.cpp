#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include <gale/base/group_by.hpp>

#include "support/arrays.hpp"

namespace gale::test {

namespace {

using Lists = std::vector<std::vector<Id>>;

template <class Groups>
Lists to_lists(const Groups& groups) {
  const auto begin = to_vector(groups.offsets);
  const auto members = to_vector(groups.entries);
  EXPECT_EQ(begin.front(), 0);
  EXPECT_EQ(static_cast<std::size_t>(begin.back()), members.size());
  Lists lists;
  for (std::size_t key = 0; key + 1 < begin.size(); ++key) {
    lists.emplace_back(members.begin() + begin[key], members.begin() + begin[key + 1]);
    std::sort(lists.back().begin(), lists.back().end());
  }
  return lists;
}

/// The item modulo each of 3, 5, and 7 for which it is odd: none to three keys, some of them twice.
struct Residues {
  template <class Visit>
  KOKKOS_FUNCTION void operator()(Id item, const Visit& visit) const {
    for (Id modulus = 3; modulus <= 7; modulus += 2) {
      if (item % modulus % 2 == 1) visit(item % modulus);
    }
  }
};

template <class Index>
Lists by_last_digit(Offset items) {
  return to_lists(group_by_key<Index>(
      "test_group", WorkerSpace(), items, 10, KOKKOS_LAMBDA(Id item) { return item % 10; }));
}

}  // namespace

TEST(GroupBy, keeps_each_item_with_its_key) {
  for (const Offset items : {0, 1, 9, 25, 100003}) {
    Lists expected(10);
    for (Id item = 0; item < items; ++item) expected[item % 10].push_back(item);
    EXPECT_EQ(by_last_digit<Offset>(items), expected);
    EXPECT_EQ(by_last_digit<Id>(items), expected);
  }
}

TEST(GroupBy, takes_any_number_of_keys_an_item) {
  constexpr Offset items = 50000;
  Lists expected(8);
  for (Id item = 0; item < items; ++item) {
    for (const Id modulus : {3, 5, 7}) {
      if (item % modulus % 2 == 1) expected[item % modulus].push_back(item);
    }
  }
  EXPECT_EQ(to_lists(group_by("test_group", WorkerSpace(), items, 8, Residues())), expected);
  EXPECT_EQ(to_lists(group_by<Id>("test_group", Kokkos::DefaultHostExecutionSpace(), items, 8, Residues())), expected);
}

TEST(GroupBy, of_no_keys_is_empty) {
  const auto groups = group_by("test_group", WorkerSpace(), 0, 0, Residues());
  EXPECT_EQ(groups.rows(), 0);
  EXPECT_EQ(to_vector(groups.offsets), std::vector<Offset>{0});
  EXPECT_EQ(groups.entries.extent(0), 0u);
}

}  // namespace gale::test
