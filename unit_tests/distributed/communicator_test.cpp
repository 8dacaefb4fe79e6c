#include <string>

#include <gtest/gtest.h>

#include <gale/distributed/communicator.hpp>
#include <gale/mesh/exchange/messages.hpp>

#include "support/message_of.hpp"

namespace gale::test {

using detail::EntriesByRank;

namespace {

/// From rank a to rank b go 7a + b numbers: 100a, 100a + 1, ...
EntriesByRank<int> numbers_from(const Communicator& ranks) {
  std::vector<std::int64_t> counts(ranks.size());
  for (int to = 0; to < ranks.size(); ++to) counts[to] = 7 * ranks.rank() + to;
  const auto numbers = detail::room_by_rank<int>("test", counts);
  for (int to = 0; to < ranks.size(); ++to) {
    for (int i = 0; i < counts[to]; ++i) numbers.entries(numbers.begin[to] + i) = 100 * ranks.rank() + i;
  }
  return numbers;
}

}  // namespace

TEST(Communicator, exchanges_what_each_rank_has_for_each) {
  for (const std::size_t limit : {Communicator::most_bytes_a_message, std::size_t(9), std::size_t(1)}) {
    const Communicator ranks(MPI_COMM_WORLD, limit);
    const auto received = detail::exchange(ranks, "test", numbers_from(ranks));
    for (int from = 0; from < ranks.size(); ++from) {
      ASSERT_EQ(received.count(from), 7 * from + ranks.rank());
      for (int i = 0; i < received.count(from); ++i)
        EXPECT_EQ(received.entries(received.begin[from] + i), 100 * from + i);
    }
  }
}

TEST(Communicator, cuts_messages_and_counts_what_goes_to_others) {
  const Communicator ranks(MPI_COMM_WORLD, 9);
  detail::exchange(ranks, "test", numbers_from(ranks));
  std::int64_t bytes = 0, messages = 0;
  for (int to = 0; to < ranks.size(); ++to) {
    if (to == ranks.rank()) continue;
    const std::int64_t here = (7 * ranks.rank() + to) * static_cast<std::int64_t>(sizeof(int));
    bytes += here;
    messages += (here + 8) / 9;
  }
  EXPECT_EQ(ranks.sent().bytes, bytes);
  EXPECT_EQ(ranks.sent().messages, messages);
}

TEST(Communicator, sums_finds_the_least_and_lists) {
  const Communicator ranks(MPI_COMM_WORLD);
  const int n = ranks.size(), rank = ranks.rank();
  EXPECT_EQ(ranks.sum(rank + 1), n * (n + 1) / 2);
  EXPECT_EQ(ranks.sum_before(rank + 1), rank * (rank + 1) / 2);
  EXPECT_EQ(ranks.least(std::int64_t(10 - rank)), 11 - n);
  EXPECT_EQ(ranks.least(0.5 - rank), 1.5 - n);
  const auto all = ranks.all(3 * rank);
  for (int other = 0; other < n; ++other) EXPECT_EQ(all[other], 3 * other);
  EXPECT_EQ(ranks.broadcast("text of " + std::to_string(rank), n - 1), "text of " + std::to_string(n - 1));
}

TEST(Communicator, refuses_limits_that_are_none) {
  EXPECT_EQ(message_of([] { Communicator(MPI_COMM_WORLD, 0); }),
            "messages can't be cut to 0 bytes: 1 to 1073741824 are possible");
  EXPECT_NE(message_of([] { Communicator(MPI_COMM_WORLD, std::size_t(1) << 31); }), "no error");
}

TEST(Together, all_throw_what_the_lowest_rank_that_fails_says) {
  const Communicator ranks(MPI_COMM_WORLD);
  const int last = ranks.size() - 1;
  const std::string prefix = last == 0 ? "" : "rank " + std::to_string(last) + ": ";
  EXPECT_EQ(message_of([&] {
              detail::together(ranks, [&] {
                if (ranks.rank() == last) throw Error("no more of it");
              });
            }),
            prefix + "no more of it");
  EXPECT_EQ(message_of([&] { detail::together(ranks, [&] { throw Error("from " + std::to_string(ranks.rank())); }); }),
            last == 0 ? "from 0" : "rank 0: from 0");
  EXPECT_EQ(message_of([&] { detail::together(ranks, [] {}); }), "no error");
}

TEST(GroupByRank, has_each_item_with_each_of_its_ranks_ascending) {
  constexpr Offset items = 20000;
  for (const int ranks : {5, 300}) {
    const auto groups = detail::group_by_rank(ranks, items, [=](Id i, const auto& visit) {
      if (i % 3 == 0) visit(i % ranks);
      if (i % 7 == 0) visit((i + 1) % ranks);
    });
    for (int rank = 0; rank < ranks; ++rank) {
      Offset at = groups.begin[rank];
      for (Id i = 0; i < items; ++i) {
        if ((i % 3 == 0 && i % ranks == rank) || (i % 7 == 0 && (i + 1) % ranks == rank)) {
          ASSERT_LT(at, groups.begin[rank + 1]);
          EXPECT_EQ(groups.entries(at++), i);
        }
      }
      EXPECT_EQ(at, groups.begin[rank + 1]);
    }
  }
}

}  // namespace gale::test
