#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <gale/base/ordered.hpp>

namespace gale::test {

TEST(Bisect, finds_the_first_that_is_not_before) {
  const std::vector<Id> ids = {1, 3, 3, 8};
  const auto place = [&](Id begin, Id end, Id sought) {
    return bisect(begin, end, [&](Id i) { return ids[i] < sought; });
  };
  EXPECT_EQ(place(0, 4, 0), 0);
  EXPECT_EQ(place(0, 4, 3), 1);
  EXPECT_EQ(place(0, 4, 4), 3);
  EXPECT_EQ(place(0, 4, 9), 4);
  EXPECT_EQ(place(2, 4, 1), 2);
  EXPECT_EQ(place(2, 2, 9), 2);
}

TEST(Gallop, finds_what_bisect_finds_from_any_begin) {
  constexpr Offset end = 40;
  for (Offset sought = 0; sought <= end; ++sought) {
    const auto is_before = [=](Offset place) { return place < sought; };
    for (Offset begin = 0; begin <= end; ++begin)
      EXPECT_EQ(gallop(begin, end, is_before), bisect(begin, end, is_before)) << sought << " from " << begin;
  }
}

TEST(HeapSort, is_that_of_the_standard_library) {
  std::mt19937 random(1);
  for (const Id count : {0, 1, 2, 3, 10, 64, 65, 1000}) {
    std::vector<Id> ids(count);
    for (Id& id : ids) id = static_cast<Id>(random() % 100);
    std::vector<Id> expected = ids;
    std::sort(expected.begin(), expected.end());
    heap_sort(
        count, [&](Id i) { return ids[i]; }, [&](Id i, Id id) { ids[i] = id; });
    EXPECT_EQ(ids, expected);
  }
}

}  // namespace gale::test
