#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <gale/algorithms/gradient/edge_pairs.hpp>

namespace gale::test {

namespace {

using detail::EdgePairRow;
using detail::EdgePairs;

/// The i-th lower end of an edge of a vertex.
Id lower_end(Id vertex, Id i) { return 1000 * vertex + 3 * i + 1; }

/// Where the third vertex of the triangle is that the i-th of `count` edges is paired with; no_id for every fifth.
Id third_place(Id i, Id count) { return i % 5 == 2 ? no_id : count - 1 - i; }

void fill(EdgePairRow row, Id vertex, Id count) {
  for (Id i = 0; i < count; ++i) row.set_id(i, lower_end(vertex, i));
  for (Id i = 0; i < count; ++i) {
    if (third_place(i, count) != no_id) row.pair(i, third_place(i, count));
  }
}

void expect_filled(const EdgePairRow& row, Id vertex, Id count) {
  ASSERT_EQ(row.size(), count);
  for (Id i = 0; i < count; ++i) {
    const Id id = lower_end(vertex, i), place = third_place(i, count);
    ASSERT_EQ(row.ids()[i], id);
    ASSERT_EQ(row.find(id), i) << count << " edges";
    ASSERT_EQ(row.find(id - 1), no_id) << count << " edges";
    ASSERT_EQ(row.find(id + 1), no_id) << count << " edges";
    ASSERT_EQ(row.third(i), place == no_id ? no_id : lower_end(vertex, place)) << "edge " << i << " of " << count;
  }
  ASSERT_EQ(row.find(0), no_id);
  ASSERT_EQ(row.find(2147483647), no_id);
}

/// On both sides of where looking through ends (16), and where places outgrow bytes (255).
const std::vector<Id>& sizes() {
  static const std::vector<Id> all = {0, 1, 2, 3, 4, 5, 15, 16, 17, 18, 64, 253, 254, 255, 256, 257, 300, 3000};
  return all;
}

}  // namespace

TEST(EdgePairRow, is_a_row_of_edges_in_no_pair_at_first) {
  for (const Id count : sizes()) {
    std::vector<Id> words(EdgePairRow::words_for(count), 0x12345678);
    EdgePairRow row(words.data());
    row.begin(count);
    ASSERT_EQ(row.size(), count);
    for (Id i = 0; i < count; ++i) row.set_id(i, lower_end(1, i));
    for (Id i = 0; i < count; ++i) ASSERT_EQ(row.third(i), no_id) << "edge " << i << " of " << count;
  }
}

TEST(EdgePairRow, finds_edges_and_their_triangles_in_narrow_and_wide_rows) {
  for (const Id count : sizes()) {
    std::vector<Id> words(EdgePairRow::words_for(count), 0x12345678);
    EdgePairRow row(words.data());
    row.begin(count);
    fill(row, 1, count);
    expect_filled(row, 1, count);
  }
}

TEST(EdgePairRow, keeps_to_its_words) {
  for (const Id count : sizes()) {
    std::vector<Id> words(EdgePairRow::words_for(count) + 4, 0x12345678);
    EdgePairRow row(words.data());
    row.begin(count);
    fill(row, 1, count);
    for (std::size_t i = words.size() - 4; i < words.size(); ++i) ASSERT_EQ(words[i], 0x12345678) << count << " edges";
  }
}

TEST(EdgePairRow, takes_a_byte_for_each_of_255_edges_and_a_word_for_each_of_256) {
  EXPECT_EQ(EdgePairRow::words_for(255), 1 + 255 + 64);
  EXPECT_EQ(EdgePairRow::words_for(256), 1 + 256 + 256);
}

TEST(EdgePairs, keep_the_rows_of_several_consumers_apart) {
  constexpr Id vertices = 2000;
  const auto count_of = [](Id vertex) { return sizes()[vertex % sizes().size()]; };
  EdgePairs pairs(vertices, 3);
  for (Id i = 0; i < vertices; ++i) {
    const Id vertex = (i * 7) % vertices;
    fill(pairs.begin(i % 3, vertex, count_of(vertex)), vertex, count_of(vertex));
  }
  for (Id v = 0; v < vertices; ++v) expect_filled(pairs.row(v), v, count_of(v));
}

TEST(EdgePairs, hold_a_row_that_is_longer_than_a_chunk) {
  constexpr Id longer = 400000;
  EdgePairs pairs(2, 1);
  fill(pairs.begin(0, 0, 4), 0, 4);
  fill(pairs.begin(0, 1, longer), 1, longer);
  expect_filled(pairs.row(0), 0, 4);
  expect_filled(pairs.row(1), 1, longer);
}

}  // namespace gale::test
