#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <gale/mesh/exchange/packed_rows.hpp>

namespace gale::test {

namespace {

using Words = std::vector<std::uint32_t>;

/// Packs rows, expects to find the same again, and returns how many bytes they took.
std::size_t packed_and_back(const Words& words, int width) {
  const auto rows = static_cast<std::int64_t>(words.size()) / width;
  const detail::PackedPieces pieces = detail::pack_rows(words.data(), rows, width);
  std::vector<char> bytes(detail::bytes_of(pieces));
  detail::write_pieces(pieces, bytes.data());
  const auto count = static_cast<std::int64_t>(bytes.size());
  EXPECT_EQ(detail::packed_rows(bytes.data(), count), rows);
  Words back(words.size(), 77);
  detail::unpack_rows(bytes.data(), count, width, back.data());
  EXPECT_EQ(back, words);
  return bytes.size();
}

}  // namespace

TEST(PackedRows, come_back_whatever_they_are) {
  std::mt19937 random(5);
  for (const int width : {1, 2, 3, 4, 8}) {
    for (const int rows : {1, 2, 3, 200, 4096, 4097, 9000}) {
      for (const std::uint32_t range : {1u, 2u, 3u, 100u, 1u << 20, ~0u}) {
        Words words(static_cast<std::size_t>(width * rows));
        for (auto& word : words) word = random() % range;
        EXPECT_LE(packed_and_back(words, width), words.size() * 5 + 9);
      }
    }
  }
  packed_and_back({0, ~0u, 0, ~0u, 1u << 31, (1u << 31) - 1, 0}, 1);
}

TEST(PackedRows, come_back_in_pieces_where_they_are_many) {
  std::mt19937 random(6);
  for (const int width : {1, 3}) {
    for (const int rows : {1 << 13, (1 << 13) + 1, 1 << 17, (1 << 17) + 1, 300000}) {
      Words words(static_cast<std::size_t>(width) * rows);
      for (auto& word : words) word = random() % 100000;
      EXPECT_LE(packed_and_back(words, width), words.size() * 5 + 400);
    }
  }
}

TEST(PackedRows, of_several_lists_come_back_apart) {
  std::mt19937 random(7);
  const std::vector<std::vector<int>> all_sizes{{5}, {0, 3}, {3, 0}, {200, 0, 10000, 1}, {0, 0}};
  for (const std::vector<int>& sizes : all_sizes) {
    std::vector<Words> lists;
    std::vector<detail::WordRows> sent;
    for (const int rows : sizes) {
      lists.emplace_back(2 * rows);
      for (auto& word : lists.back()) word = random() % 1000;
    }
    for (Words& list : lists) sent.push_back({list.data(), static_cast<std::int64_t>(list.size() / 2), 2});
    const detail::PackedPieces pieces = detail::pack_lists(sent);
    std::vector<char> bytes(detail::bytes_of(pieces));
    detail::write_pieces(pieces, bytes.data());
    const auto found = detail::lists_in(bytes.data(), bytes.size(), static_cast<int>(lists.size()));
    ASSERT_EQ(found.size(), lists.size());
    for (std::size_t i = 0; i < lists.size(); ++i) {
      ASSERT_EQ(found[i].rows(), sent[i].rows);
      Words back(lists[i].size(), 77);
      detail::unpack_rows(found[i].bytes, found[i].count, 2, back.data());
      EXPECT_EQ(back, lists[i]);
    }
  }
}

TEST(PackedRows, take_no_bytes_if_there_are_none) {
  EXPECT_TRUE(detail::pack_lists({{nullptr, 0, 1}, {nullptr, 0, 3}}).empty());
  EXPECT_TRUE(detail::pack_rows(nullptr, 0, 3).empty());
  EXPECT_EQ(detail::packed_rows(nullptr, 0), 0);
  detail::unpack_rows(nullptr, 0, 3, nullptr);
}

TEST(PackedRows, take_few_bytes_where_they_ascend_or_repeat) {
  Words ids, pairs;
  for (std::uint32_t i = 0; i < 100000; ++i) {
    ids.push_back(4000000000u + i);
    pairs.insert(pairs.end(), {i * 3, 0});
  }
  EXPECT_LE(packed_and_back(ids, 1), 250u);  // of 25 parts
  EXPECT_LE(packed_and_back(pairs, 2), 300u);
  ids.resize(4096);
  pairs.resize(2 * 4096);
  EXPECT_LE(packed_and_back(ids, 1), 16u);
  EXPECT_LE(packed_and_back(pairs, 2), 24u);
  Words near;
  for (std::uint32_t i = 0; i < 100000; ++i) near.push_back(i + i % 7);
  EXPECT_LE(packed_and_back(near, 1), near.size() * 2);
}

}  // namespace gale::test
