#include <atomic>
#include <random>
#include <thread>

#include <gtest/gtest.h>

#include <gale/base/error.hpp>
#include <gale/ttk/block_store.hpp>
#include <gale/ttk/per_thread.hpp>

namespace gale::test {

namespace {

/// A block of a hundred words that tell its segment.
ttk::Block block_of(Id segment) {
  ttk::Block block;
  block.words.reset(new Id[100]);
  std::fill(block.words.get(), block.words.get() + 100, segment);
  block.rows = {segment, 1, block.words.get(), block.words.get()};
  block.bytes = 100 * sizeof(Id);
  return block;
}

constexpr std::size_t bytes_of_one = 100 * sizeof(Id);

TEST(TtkBlockStore, makes_a_block_once_and_keeps_it_within_the_budget) {
  ttk::BlockStore store(4, 4 * bytes_of_one);
  store.add(Relation::VV);
  int made = 0;
  for (int round = 0; round < 3; ++round) {
    for (Id segment = 0; segment < 4; ++segment) {
      auto& slot = store.hold(Relation::VV, segment, [&] { return ++made, block_of(segment); });
      EXPECT_EQ(slot.rows().ids[99], segment);
      store.release(slot);
    }
  }
  EXPECT_EQ(made, 4);
  EXPECT_EQ(store.bytes(), 4 * bytes_of_one);
}

TEST(TtkBlockStore, drops_what_nobody_holds_when_the_budget_ends) {
  ttk::BlockStore store(20, 3 * bytes_of_one);
  store.add(Relation::VV);
  store.add(Relation::ET);
  auto& held = store.hold(Relation::ET, 0, [] { return block_of(0); });
  for (Id segment = 0; segment < 20; ++segment) {
    store.release(store.hold(Relation::VV, segment, [&] { return block_of(segment); }));
    EXPECT_LE(store.bytes(), 4 * bytes_of_one);
  }
  EXPECT_EQ(held.rows().ids[50], 0);
  int made = 0;
  store.release(store.hold(Relation::ET, 0, [&] { return ++made, block_of(0); }));
  EXPECT_EQ(made, 0);
  store.release(held);
}

TEST(TtkBlockStore, takes_blocks_that_were_made_elsewhere) {
  ttk::BlockStore store(2, 10 * bytes_of_one);
  store.add(Relation::VT);
  store.put(Relation::VT, 1, block_of(1));
  store.put(Relation::VT, 1, block_of(0));  // is there already
  int made = 0;
  auto& slot = store.hold(Relation::VT, 1, [&] { return ++made, block_of(1); });
  EXPECT_EQ(made, 0);
  EXPECT_EQ(slot.rows().ids[0], 1);
  EXPECT_EQ(store.bytes(), bytes_of_one);
  store.release(slot);
}

TEST(TtkBlockStore, leaves_no_block_where_making_one_failed) {
  ttk::BlockStore store(1, 1000);
  store.add(Relation::VT);
  const auto fail = []() -> ttk::Block { throw Error("no"); };
  EXPECT_THROW(store.hold(Relation::VT, 0, fail), Error);
  EXPECT_EQ(store.bytes(), 0u);
  store.release(store.hold(Relation::VT, 0, [] { return block_of(0); }));
  EXPECT_EQ(store.bytes(), bytes_of_one);
}

TEST(TtkBlockStore, gives_many_threads_the_right_blocks_while_it_drops_others) {
  ttk::BlockStore store(50, 8 * bytes_of_one);
  store.add(Relation::VV);
  std::atomic<int> wrong{0};
  std::vector<std::thread> threads;
  for (int thread = 0; thread < 6; ++thread) {
    threads.emplace_back([&, thread] {
      std::mt19937 random(thread);
      for (int i = 0; i < 5000; ++i) {
        const Id segment = static_cast<Id>(random() % 50);
        auto& slot = store.hold(Relation::VV, segment, [&] { return block_of(segment); });
        if (slot.rows().ids[0] != segment || slot.rows().ids[99] != segment) ++wrong;
        store.release(slot);
      }
    });
  }
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_LE(store.bytes(), (8 + 6) * bytes_of_one);
}

TEST(TtkPerThread, gives_each_thread_one_state_of_each_object) {
  ttk::PerThread<int> first, second;
  const auto one = [] { return std::make_unique<int>(1); };
  first.here(one) = 10;
  second.here(one) = 20;
  EXPECT_EQ(first.here(one), 10);
  EXPECT_EQ(second.here(one), 20);
  std::thread([&] { EXPECT_EQ(first.here(one), 1); }).join();
}

}  // namespace

}  // namespace gale::test
