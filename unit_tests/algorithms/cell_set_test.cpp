#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <gale/algorithms/gradient/incidences.hpp>

namespace gale::test {

namespace {

using detail::CellSet;

template <int Words>
std::vector<int> members_of(CellSet<Words> set) {
  std::vector<int> members;
  for (; !set.empty(); set.remove_lowest()) members.push_back(set.lowest());
  return members;
}

std::set<int> some_cells(std::mt19937& random, int capacity, int count) {
  std::set<int> cells;
  for (int i = 0; i < count; ++i) cells.insert(static_cast<int>(random() % capacity));
  return cells;
}

template <int Words>
CellSet<Words> set_of(const std::set<int>& cells) {
  auto set = CellSet<Words>::none();
  for (const int cell : cells) set.add(cell);
  return set;
}

template <class Set>
class CellSetOf : public testing::Test {};
using Sets = testing::Types<CellSet<1>, CellSet<2>, CellSet<4>>;
TYPED_TEST_SUITE(CellSetOf, Sets);

TYPED_TEST(CellSetOf, each_size_is_empty_at_first) {
  EXPECT_TRUE(TypeParam::none().empty());
  EXPECT_FALSE(TypeParam::none().is_single());
  EXPECT_FALSE(TypeParam::none().has(0));
  EXPECT_FALSE(TypeParam::none().has(TypeParam::capacity - 1));
}

TYPED_TEST(CellSetOf, each_size_holds_each_cell) {
  for (int cell = 0; cell < TypeParam::capacity; ++cell) {
    TypeParam set = TypeParam::none();
    set.add(cell);
    EXPECT_TRUE(set.is_single());
    EXPECT_EQ(members_of(set), std::vector<int>{cell});
    for (int other = 0; other < TypeParam::capacity; ++other) ASSERT_EQ(set.has(other), other == cell);
  }
}

TYPED_TEST(CellSetOf, each_size_is_what_a_set_is) {
  constexpr int words = TypeParam::capacity / 64;
  std::mt19937 random(1);
  for (int count = 0; count < 100; ++count) {
    const auto a = some_cells(random, TypeParam::capacity, count % 50),
               b = some_cells(random, TypeParam::capacity, count / 4);
    std::set<int> both = a, rest = a;
    both.insert(b.begin(), b.end());
    for (const int cell : b) rest.erase(cell);
    const TypeParam set_a = set_of<words>(a), set_b = set_of<words>(b);
    EXPECT_EQ(members_of(set_a), std::vector<int>(a.begin(), a.end()));
    EXPECT_EQ(members_of(set_a | set_b), std::vector<int>(both.begin(), both.end()));
    EXPECT_EQ(members_of(set_a - set_b), std::vector<int>(rest.begin(), rest.end()));
    EXPECT_EQ(set_a.is_single(), a.size() == 1);
    EXPECT_EQ(set_b.is_single(), b.size() == 1);
    EXPECT_EQ((set_a - set_b).empty(), rest.empty());
  }
}

}  // namespace

}  // namespace gale::test
