#include <gtest/gtest.h>

#include <gale/runtime/leaders/block_store.hpp>

namespace gale::test {

namespace {

using detail::Arena;
using detail::BlockStore;
using detail::Lease;

constexpr Offset words = 256;
constexpr std::size_t arena_bytes = words * sizeof(Id);

/// Fills an arena with one segment whose only block holds the segment's number, and publishes it.
void publish(BlockStore& store, Arena& arena, Id segment, Id unread = 0) {
  arena.segments = {segment};
  arena.directory = {0};
  arena.words.data()[0] = segment;
  store.publish(arena, unread);
}

/// The first word of a lease's arena.
Id word_of(const Lease& lease) { return *lease.arena().words.data(); }

void publish(BlockStore& store, Id segment, Id unread = 0) {
  Arena* const arena = store.take(BlockStore::Need::must_have, words);
  ASSERT_NE(arena, nullptr);
  publish(store, *arena, segment, unread);
}

}  // namespace

TEST(BlockStore, finds_what_was_published_and_nothing_else) {
  BlockStore store(10, 4 * arena_bytes);
  publish(store, 7);
  EXPECT_FALSE(store.find(6));
  const Lease lease = store.find(7);
  ASSERT_TRUE(lease);
  EXPECT_EQ(word_of(lease), 7);
}

TEST(BlockStore, evicts_what_was_used_longest_ago) {
  BlockStore store(10, 3 * arena_bytes);
  for (const Id s : {1, 2, 3}) publish(store, s);
  store.find(1);
  publish(store, 4);
  EXPECT_TRUE(store.find(1));
  EXPECT_FALSE(store.find(2));
  EXPECT_TRUE(store.find(3));
  EXPECT_EQ(store.evicted(), 1);
  EXPECT_EQ(store.peak_bytes(), 3 * arena_bytes);
}

TEST(BlockStore, never_evicts_what_is_pinned_and_exceeds_its_budget_instead) {
  BlockStore store(10, 2 * arena_bytes);
  publish(store, 1);
  publish(store, 2);
  const Lease one = store.find(1), two = store.find(2);
  EXPECT_EQ(store.take(BlockStore::Need::can_wait, words), nullptr);
  publish(store, 3);
  EXPECT_EQ(word_of(one), 1);
  EXPECT_EQ(word_of(two), 2);
  EXPECT_EQ(store.peak_bytes(), 3 * arena_bytes);
}

TEST(BlockStore, keeps_what_a_sweep_has_still_to_read_unless_it_must_not) {
  BlockStore store(10, 2 * arena_bytes);
  publish(store, 1, 1);
  publish(store, 2, 1);
  EXPECT_EQ(store.take(BlockStore::Need::can_wait, words), nullptr);
  Lease lease = store.find(2);
  EXPECT_TRUE(lease.release_read(1));
  publish(store, 3, 1);
  EXPECT_TRUE(store.find(1));
  EXPECT_FALSE(store.find(2));
  publish(store, 4, 1);
  EXPECT_TRUE(store.find(1));
  EXPECT_FALSE(store.find(3)) << "it would be read last";
  store.forget_unread();
  EXPECT_NE(store.take(BlockStore::Need::can_wait, words), nullptr);
}

TEST(BlockStore, hides_blocks_that_are_missing) {
  BlockStore store(10, 2 * arena_bytes);
  Arena& arena = *store.take(BlockStore::Need::must_have, words);
  arena.segments = {4, 5};
  arena.directory = {-1, 0};
  store.publish(arena, 0);
  EXPECT_FALSE(store.find(4));
  EXPECT_TRUE(store.find(5));
}

TEST(BlockStore, gives_an_arena_that_is_large_enough) {
  BlockStore store(10, 2 * arena_bytes);
  publish(store, 1);
  Arena& large = *store.take(BlockStore::Need::must_have, 10 * words);
  EXPECT_EQ(large.words.size(), static_cast<std::size_t>(10 * words));
  EXPECT_TRUE(store.find(1)) << "its arena is too small to be taken instead";
  EXPECT_EQ(store.peak_bytes(), 11 * arena_bytes);
  store.give_back(large);
  EXPECT_EQ(store.take(BlockStore::Need::must_have, words), &large);
}

}  // namespace gale::test
