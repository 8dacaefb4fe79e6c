#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <gale/mesh/exchange/global_index.hpp>

#include "support/arrays.hpp"

namespace gale::test {

TEST(DistinctIds, are_ascending_and_say_where_each_stood_first) {
  std::mt19937_64 random(3);
  std::vector<GlobalId> ids;
  for (int i = 0; i < 30000; ++i) ids.push_back(static_cast<GlobalId>(random() % 20000) << 30);
  const auto found = detail::distinct_ids(view_of(ids));
  const std::set<GlobalId> distinct(ids.begin(), ids.end());
  ASSERT_EQ(found.ids.extent(0), distinct.size());
  Offset at = 0;
  for (const GlobalId id : distinct) {
    EXPECT_EQ(found.ids(at), id);
    EXPECT_EQ(found.places(at), std::find(ids.begin(), ids.end(), id) - ids.begin());
    ++at;
  }
}

TEST(DistinctIds, of_none_and_of_ascending_ones) {
  EXPECT_EQ(detail::distinct_ids(view_of(std::vector<GlobalId>())).ids.extent(0), 0u);
  const std::vector<GlobalId> ids = {0, 4, GlobalId(1) << 62};
  const auto found = detail::distinct_ids(view_of(ids));
  ASSERT_EQ(found.ids.extent(0), 3u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(found.ids(i), ids[i]);
    EXPECT_EQ(found.places(i), i);
  }
}

class GlobalIndexFor : public ::testing::TestWithParam<detail::GlobalIndex::Lookups> {};

TEST_P(GlobalIndexFor, finds_dense_and_sparse_ids_and_no_others) {
  for (const GlobalId stride : {GlobalId(1), GlobalId(3), GlobalId(9), GlobalId(1) << 40}) {
    std::vector<GlobalId> ids;
    for (GlobalId i = 0; i < 1000; ++i) ids.push_back(7 + i * stride);
    const detail::GlobalIndex index(view_of(ids), GetParam());
    for (Id i = 0; i < 1000; ++i) {
      EXPECT_EQ(index.find(ids[i]), i);
      if (stride > 1) EXPECT_EQ(index.find(ids[i] + 1), no_id);
    }
    EXPECT_EQ(index.find(6), no_id);
    EXPECT_EQ(index.find(ids.back() + 1), no_id);
    EXPECT_EQ(index.find(0), no_id);
  }
  EXPECT_EQ(detail::GlobalIndex(view_of(std::vector<GlobalId>()), GetParam()).find(0), no_id);
  EXPECT_EQ(detail::GlobalIndex().find(5), no_id);
}

INSTANTIATE_TEST_SUITE_P(Lookups, GlobalIndexFor,
                         ::testing::Values(detail::GlobalIndex::Lookups::some, detail::GlobalIndex::Lookups::many));

}  // namespace gale::test
