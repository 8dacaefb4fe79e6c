#include <random>
#include <unordered_map>

#include <gtest/gtest.h>

#include <gale/base/hash_table.hpp>

namespace gale::test {

TEST(HashTable, knows_what_a_map_knows_whatever_its_first_size) {
  for (const std::size_t room : {0, 1, 512, 100000}) {
    HashTable<int> table(room);
    std::unordered_map<std::uint64_t, int> map;
    std::mt19937_64 random(3);
    for (int i = 0; i < 20000; ++i) {
      const std::uint64_t key = pair_key(static_cast<Id>(random() % 100), static_cast<Id>(random() % 200));
      const auto [value, is_new] = table.insert(key);
      ASSERT_EQ(is_new, map.emplace(key, i).second);
      if (is_new) value = i;
      ASSERT_EQ(value, map.at(key));
    }
    EXPECT_EQ(table.size(), map.size());
    for (Id a = 0; a < 110; ++a) {
      for (Id b = 0; b < 210; ++b) {
        const auto known = map.find(pair_key(a, b));
        const int* const found = table.find(pair_key(a, b));
        ASSERT_EQ(found != nullptr, known != map.end());
        if (found != nullptr) ASSERT_EQ(*found, known->second);
      }
    }
  }
}

TEST(HashTable, tells_keys_apart_by_all_their_bits) {
  HashTable<int> table;
  for (int bit = 0; bit < 64; ++bit) table.insert(std::uint64_t(1) << bit).first = bit;
  EXPECT_EQ(table.find(0), nullptr);
  for (int bit = 0; bit < 64; ++bit) EXPECT_EQ(*table.find(std::uint64_t(1) << bit), bit);
}

TEST(HashTable, forgets_everything_when_it_is_cleared) {
  HashTable<Id> table(4);
  for (int round = 0; round < 100; ++round) {
    table.clear();
    for (Id i = 0; i < 50; ++i) {
      ASSERT_EQ(table.find(i), nullptr);
      const auto [value, is_new] = table.insert(i);
      ASSERT_TRUE(is_new);
      value = round;
    }
    EXPECT_EQ(table.size(), 50u);
    for (Id i = 0; i < 50; ++i) ASSERT_EQ(*table.find(i), round);
  }
}

TEST(HashTable, serves_sets_of_any_sizes_one_after_the_other) {
  HashTable<Id> table(4);
  std::mt19937_64 random(5);
  for (Id i = 0; i < 5000; ++i) table.insert(i).first = i;  // grows before it is cleared for the first time
  for (int round = 0; round < 200; ++round) {
    table.clear();
    const Id count = static_cast<Id>(random() % (random() % 3 == 0 ? 20000 : 50));
    for (Id i = 0; i < count; ++i) {
      const auto [value, is_new] = table.insert(pair_key(i, round));
      ASSERT_TRUE(is_new);
      value = i;
    }
    ASSERT_EQ(table.size(), static_cast<std::size_t>(count));
    for (Id i = 0; i < 20000; ++i) {
      const Id* const found = table.find(pair_key(i, round));
      ASSERT_EQ(found != nullptr, i < count);
      if (found != nullptr) ASSERT_EQ(*found, i);
      ASSERT_EQ(table.find(pair_key(i, round + 1)), nullptr);
    }
  }
}

}  // namespace gale::test
