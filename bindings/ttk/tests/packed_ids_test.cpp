#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <gale/ttk/packed_ids.hpp>

namespace gale::test {

namespace {

/// Ids from `least` to `greatest`, both among them.
std::vector<Id> some_ids(Id least, Id greatest, std::size_t count) {
  std::mt19937 random(3);
  std::uniform_int_distribution<Id> any(least, greatest);
  std::vector<Id> ids(count);
  for (Id& id : ids) id = any(random);
  ids.front() = greatest;
  ids.back() = least;
  return ids;
}

void expect_packed(Id least, Id greatest, std::size_t count) {
  SCOPED_TRACE(std::to_string(least) + " to " + std::to_string(greatest) + ", " + std::to_string(count));
  const std::vector<Id> ids = some_ids(least, greatest, count);
  Array<Id, HostMemory> array("ids", count);
  std::copy(ids.begin(), ids.end(), array.data());
  const ttk::PackedIds packed(array, least, greatest);
  ASSERT_EQ(packed.size(), static_cast<Id>(count));
  for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(packed[static_cast<Id>(i)], ids[i]) << i;
}

TEST(TtkPackedIds, are_those_that_were_packed) {
  for (const Id greatest : {0, 1, 2, 3, 255, 256, 70000, 20123456, std::numeric_limits<Id>::max()}) {
    for (const Id least : {0, -2}) {
      for (const std::size_t count : {2, 7, 8, 9, 1000, 10007})
        expect_packed(std::min(least, greatest), greatest, count);
    }
  }
}

TEST(TtkPackedIds, may_be_none) {
  const ttk::PackedIds none(Array<Id, HostMemory>("ids", 0), 0, -1);
  EXPECT_EQ(none.size(), 0);
}

TEST(TtkPackedIds, take_no_more_bits_than_the_greatest) {
  Array<Id, HostMemory> array("ids", 8000);
  for (Id i = 0; i < 8000; ++i) array(i) = i;
  EXPECT_EQ(ttk::PackedIds(array, 0, 7999).bytes(), 8000 * 13 / 8 + sizeof(std::uint64_t));
  EXPECT_EQ(ttk::PackedIds(array, -193, 7999).bytes(), 8000 * 14 / 8 + sizeof(std::uint64_t));
}

}  // namespace

}  // namespace gale::test
