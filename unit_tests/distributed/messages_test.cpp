#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <gale/distributed/communicator.hpp>
#include <gale/mesh/exchange/messages.hpp>

#include "support/message_of.hpp"

namespace gale::test {

using detail::EntriesByRank;

namespace {

/// The i-th of the numbers that a rank sends another: few bytes can tell none of them from those before.
std::int64_t number(int from, int to, std::int64_t i) {
  std::mt19937_64 random(static_cast<std::uint64_t>((i * 64 + from) * 64 + to));
  return static_cast<std::int64_t>(random() >> 2);
}

/// Numbers from this rank to each, so many.
EntriesByRank<std::int64_t> numbers_for_all(const Ranks& ranks, const std::vector<std::int64_t>& counts) {
  const auto numbers = detail::room_by_rank<std::int64_t>("test", counts);
  for (int to = 0; to < ranks.size(); ++to) {
    for (std::int64_t i = 0; i < counts[to]; ++i) numbers.entries(numbers.begin[to] + i) = number(ranks.rank(), to, i);
  }
  return numbers;
}

/// Checks that all numbers are here that so many were sent of: count_of(from, to).
template <class CountOf>
void expect_numbers(const Ranks& ranks, const EntriesByRank<std::int64_t>& received, const CountOf& count_of) {
  for (int from = 0; from < ranks.size(); ++from) {
    ASSERT_EQ(received.count(from), count_of(from, ranks.rank()));
    for (Offset i = 0; i < received.count(from); ++i)
      ASSERT_EQ(received.entries(received.begin[from] + i), number(from, ranks.rank(), i)) << "from " << from;
  }
}

}  // namespace

TEST(Messages, short_and_long_ones_come_as_they_were_sent) {
  const Communicator ranks(MPI_COMM_WORLD, 1000);
  // Messages without a number, short ones on all ranks, long ones, a long one between two ranks alone, and around the
  // length that fits.
  std::vector<std::int64_t> longest{0, 3, 20000};
  for (std::int64_t count = 80; count < 120; ++count) longest.push_back(count);
  for (const std::int64_t most : longest) {
    for (const bool from_last_alone : {false, true}) {
      SCOPED_TRACE(std::to_string(most) + (from_last_alone ? " from one rank" : ""));
      const auto count_of = [&](int from, int to) -> std::int64_t {
        const bool is_chosen = from == ranks.size() - 1 && to == 0;
        return from_last_alone && !is_chosen ? (from + to) % 3 : most;
      };
      std::vector<std::int64_t> counts, others;
      for (int to = 0; to < ranks.size(); ++to) {
        counts.push_back(count_of(ranks.rank(), to));
        others.push_back((ranks.rank() + to) % 2);
      }
      const auto [received, few] =
          detail::exchange_lists(ranks, "test", numbers_for_all(ranks, counts), numbers_for_all(ranks, others));
      expect_numbers(ranks, received, count_of);
      expect_numbers(ranks, few, [](int from, int to) { return (from + to) % 2; });
    }
  }
}

TEST(Messages, fail_on_all_ranks_where_one_cannot_make_its_own) {
  const Communicator ranks(MPI_COMM_WORLD);
  for (int bad = 0; bad < ranks.size(); ++bad) {
    const auto send = [&] {
      detail::send_lists(ranks, "test", [&] {
        if (ranks.rank() == bad) throw Error("has nothing to say");
        return std::make_tuple(numbers_for_all(ranks, std::vector<std::int64_t>(ranks.size(), 1000)));
      });
    };
    const std::string says = (ranks.size() == 1 ? "" : "rank " + std::to_string(bad) + ": ") + "has nothing to say";
    EXPECT_EQ(message_of(send), says);
  }
  // The ranks are still in step.
  EXPECT_EQ(ranks.sum(1), ranks.size());
}

TEST(Messages, go_round_until_nobody_has_any) {
  const Communicator ranks(MPI_COMM_WORLD);
  const int here = ranks.rank(), next = (here + 1) % ranks.size();
  // Each rank sends a number around, which becomes one less at each rank.
  int steps = 0;
  std::vector<std::int64_t> ended;
  detail::in_rounds<std::int64_t>(ranks, "test", [&](const EntriesByRank<std::int64_t>& received) {
    std::vector<std::int64_t> left;
    if (steps++ == 0) left.push_back(10 * here);
    for (Offset i = 0; i < received.count(); ++i) {
      (received.entries(i) == 0 ? ended : left).push_back(received.entries(i) - (received.entries(i) == 0 ? 0 : 1));
    }
    std::vector<std::pair<int, std::int64_t>> sent;
    if (next == here) left.clear();  // nobody else is there
    for (const std::int64_t one : left) sent.emplace_back(next, one);
    return detail::entries_by_rank(ranks.size(), "test", sent);
  });
  if (ranks.size() == 1) {
    EXPECT_EQ(steps, 1);
    return;
  }
  EXPECT_EQ(steps, 10 * (ranks.size() - 1) + 2);
  EXPECT_EQ(ranks.sum(static_cast<std::int64_t>(ended.size())), ranks.size());
}

}  // namespace gale::test
