#include <gtest/gtest.h>

#include <gale/mesh/distinct_rows.hpp>

#include "support/arrays.hpp"

namespace gale::test {

namespace {

using detail::FewDistinct;

std::vector<Id> ids_in(const FewDistinct& few) {
  std::vector<Id> ids;
  for (Id i = 0; i < few.size(); ++i) ids.push_back(few[i]);
  return ids;
}

/// `count` candidates a row, of which `distinct` are distinct, the greatest first.
struct Descending {
  Id count;
  Id distinct;

  template <class Visit>
  KOKKOS_FUNCTION void operator()(Id row, const Visit& visit) const {
    for (Id i = 0; i < count; ++i) visit(1000 * row + distinct - 1 - i % distinct);
  }
};

/// Row r has the candidates 0 to 50 * r - 1, twice: with r = 0 none, from r = 1 on more than a thread keeps.
struct Growing {
  template <class Visit>
  KOKKOS_FUNCTION void operator()(Id row, const Visit& visit) const {
    for (Id i = 0; i < 100 * row; ++i) visit(i / 2);
  }
};

template <class Candidates>
void expect_rows(const std::vector<std::vector<Id>>& expected, const Candidates& candidates) {
  const auto rows = detail::distinct_rows(WorkerSpace(), "tests", static_cast<Offset>(expected.size()), candidates);
  const auto begin = to_vector(rows.begin), values = to_vector(rows.values), row_of = to_vector(rows.row_of);
  ASSERT_EQ(begin.size(), expected.size() + 1);
  EXPECT_EQ(begin[0], 0);
  ASSERT_EQ(static_cast<std::size_t>(begin.back()), values.size());
  ASSERT_EQ(row_of.size(), values.size());
  for (std::size_t row = 0; row < expected.size(); ++row) {
    EXPECT_EQ(std::vector<Id>(values.begin() + begin[row], values.begin() + begin[row + 1]), expected[row])
        << "row " << row;
    for (Id i = begin[row]; i < begin[row + 1]; ++i) ASSERT_EQ(row_of[i], static_cast<Id>(row));
  }
}

std::vector<Id> consecutive(Id first, Id count) {
  std::vector<Id> ids;
  for (Id i = 0; i < count; ++i) ids.push_back(first + i);
  return ids;
}

}  // namespace

TEST(FewDistinct, are_in_order_and_once) {
  FewDistinct few;
  EXPECT_EQ(few.size(), 0);
  for (const Id id : {5, 3, 9, 3, 5, 9, 0, 7, 0}) few.insert(id);
  EXPECT_EQ(ids_in(few), (std::vector<Id>{0, 3, 5, 7, 9}));
}

TEST(FewDistinct, are_as_many_as_fit_however_often_they_come) {
  FewDistinct few;
  for (int again = 0; again < 3; ++again) {
    for (Id i = 0; i < FewDistinct::capacity; ++i) few.insert(i * 7 % FewDistinct::capacity);
  }
  EXPECT_EQ(ids_in(few), consecutive(0, FewDistinct::capacity));
}

TEST(FewDistinct, are_too_many_from_one_more_on) {
  for (const Id one_more : {-1, 17, 2 * FewDistinct::capacity}) {
    FewDistinct few;
    for (Id i = 0; i < FewDistinct::capacity; ++i) few.insert(2 * i);
    few.insert(16);
    EXPECT_EQ(few.size(), FewDistinct::capacity);
    few.insert(one_more);
    EXPECT_EQ(few.size(), FewDistinct::too_many) << one_more;
    few.insert(16);
    EXPECT_EQ(few.size(), FewDistinct::too_many) << "it stays so";
  }
}

TEST(DistinctRows, of_no_candidates_are_empty) {
  expect_rows({{}, {}, {}}, Descending{0, 1});
  expect_rows({}, Descending{0, 1});
}

TEST(DistinctRows, are_the_distinct_ones_ascending) { expect_rows({{0, 1, 2}, {1000, 1001, 1002}}, Descending{7, 3}); }

TEST(DistinctRows, may_be_just_as_long_as_a_thread_keeps_or_longer) {
  for (const Id distinct :
       {FewDistinct::capacity - 1, FewDistinct::capacity, FewDistinct::capacity + 1, 3 * FewDistinct::capacity}) {
    expect_rows({consecutive(0, distinct), consecutive(1000, distinct), consecutive(2000, distinct)},
                Descending{2 * distinct, distinct});
  }
}

TEST(DistinctRows, may_be_short_and_long_side_by_side) {
  expect_rows({{}, consecutive(0, 50), consecutive(0, 100), consecutive(0, 150)}, Growing());
}

}  // namespace gale::test
