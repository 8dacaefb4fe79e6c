#include <vector>

#include <gtest/gtest.h>

#include <gale/relations/segment_rows.hpp>

namespace gale::test {

namespace {

/// Two tetrahedra at vertex 5 and one at vertex 6, with places that fit a byte, written with any width.
template <class Place>
void expect_links(int width) {
  const std::vector<Id> offsets = {0, 2, 3};
  const std::vector<Place> places = {0, 1, 2, 3, 4, 250, 7, 8, 9};
  const LinkRows links{5, 2, offsets.data(), places.data(), width};
  ASSERT_EQ(links[5].size(), 2);
  ASSERT_EQ(links[6].size(), 1);
  EXPECT_EQ(links[5](0, 0), 0);
  EXPECT_EQ(links[5](1, 0), 3);
  EXPECT_EQ(links[5](1, 2), 250);
  EXPECT_EQ(links[6](0, 1), 8);
}

}  // namespace

TEST(Rows, lie_between_their_offsets) {
  const std::vector<Id> offsets = {3, 3, 5}, ids = {9, 9, 9, 20, 30};
  const Rows rows{7, 2, offsets.data(), ids.data()};
  EXPECT_EQ(rows[7].size(), 0);
  ASSERT_EQ(rows[8].size(), 2);
  EXPECT_EQ(rows[8][0], 20);
  EXPECT_EQ(rows[8][1], 30);
}

TEST(LinkRows, have_places_of_any_width) {
  expect_links<std::uint8_t>(1);
  expect_links<std::uint16_t>(2);
  expect_links<Id>(4);
}

TEST(LinkRows, are_as_narrow_as_their_places_allow) {
  EXPECT_EQ(width_for(0), 1);
  EXPECT_EQ(width_for(256), 1);
  EXPECT_EQ(width_for(257), 2);
  EXPECT_EQ(width_for(65536), 2);
  EXPECT_EQ(width_for(65537), 4);
}

TEST(SegmentRows, reads_blocks) {
  const std::vector<Id> vv = {0, 1, 3, /* ids */ 8, 4, 6};
  std::vector<Id> link = {0, 1, 1, /* width */ 1, /* places */ 0};
  *reinterpret_cast<std::uint8_t*>(&link[4]) = 200;
  SegmentRows rows(3, {Interval{4, 6}});
  const BlockLayout layout{4, 2};
  rows.set(Relation::VV, layout.rows_in(vv.data()));
  rows.set(layout.links_in(link.data()));
  EXPECT_EQ(rows[Relation::VV][4].size(), 1);
  EXPECT_EQ(rows[Relation::VV][4][0], 8);
  EXPECT_EQ(rows[Relation::VV][5].size(), 2);
  EXPECT_EQ(rows[Relation::VV][5][1], 6);
  EXPECT_EQ(rows.links()[4](0, 0), 200);
  EXPECT_EQ(rows.links()[5].size(), 0);
}

TEST(SegmentRows, has_its_simplices_alone) {
  const SegmentRows rows(3, {Interval{4, 6}, Interval{0, 9}});
  EXPECT_EQ(rows.segment(), 3);
  EXPECT_FALSE(rows.has(0, 3));
  EXPECT_TRUE(rows.has(0, 4));
  EXPECT_TRUE(rows.has(0, 5));
  EXPECT_FALSE(rows.has(0, 6));
  EXPECT_TRUE(rows.has(1, 3));
  EXPECT_FALSE(rows.has(2, 3));
  EXPECT_FALSE(SegmentRows().has(0, 0));
}

#ifndef NDEBUG
TEST(SegmentRowsDeathTest, asserts_what_its_reader_has_to_keep_to) {
  const std::vector<Id> vv = {0, 1, 3, /* ids */ 8, 4, 6};
  SegmentRows rows(3, {Interval{4, 6}});
  rows.set(Relation::VV, BlockLayout{4, 2}.rows_in(vv.data()));
  EXPECT_DEATH(rows[Relation::VT], "not asked for this relation");
  EXPECT_DEATH(rows.links(), "not asked for links");
  EXPECT_DEATH(rows[Relation::VV][6], "of other simplices");
  EXPECT_DEATH(rows[Relation::VV][3], "of other simplices");
}
#endif

TEST(SegmentRows, has_an_interval_for_the_rows_of_each_relation) {
  const SegmentRows rows(3, {Interval{4, 6}, Interval{10, 13}, Interval{}, Interval{7, 8}});
  EXPECT_EQ(rows.interval(Relation::VT).first, 4);
  EXPECT_EQ(rows.interval(Relation::EF).first, 10);
  EXPECT_EQ(rows.interval(Relation::TT).last, 8);
  std::vector<Id> edges;
  for (const Id edge : rows.interval(Relation::EV)) edges.push_back(edge);
  EXPECT_EQ(edges, (std::vector<Id>{10, 11, 12}));
}

TEST(BlockLayout, counts_the_words_of_a_block) {
  EXPECT_EQ(BlockLayout::words(2, 3), 6);
  EXPECT_EQ(BlockLayout::link_words(2, 1, 1), 5) << "three bytes are a word";
  EXPECT_EQ(BlockLayout::link_words(2, 3, 1), 7) << "nine bytes are three";
  EXPECT_EQ(BlockLayout::link_words(2, 3, 4), 13);
}

}  // namespace gale::test
