#include <map>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <gale/distributed/sharing/vertex_directory.hpp>
#include <gale/mesh/exchange/places.hpp>

namespace gale::test {

namespace {

using Ids = Array<GlobalId, HostMemory>;

Ids to_ids(const std::vector<GlobalId>& values) {
  const Ids ids("ids", values.size());
  for (std::size_t i = 0; i < values.size(); ++i) ids(i) = values[i];
  return ids;
}

void expect_equal(const Array<detail::VertexEntry, HostMemory>& some,
                  const Array<detail::VertexEntry, HostMemory>& others) {
  ASSERT_EQ(some.extent(0), others.extent(0));
  for (std::size_t i = 0; i < some.extent(0); ++i) {
    EXPECT_EQ(some(i).giver, others(i).giver) << i;
    EXPECT_EQ(some(i).place, others(i).place) << i;
    EXPECT_EQ(some(i).owner, others(i).owner) << i;
  }
}

}  // namespace

TEST(SumsById, sums_count_all_lower_ids_of_all_ranks) {
  const Communicator ranks(MPI_COMM_WORLD, 100);
  std::mt19937 random(7);
  std::vector<GlobalId> mine, counts;
  std::vector<std::pair<GlobalId, GlobalId>> all;
  for (GlobalId id = 0; id < 500; ++id) {
    const GlobalId count = random() % 5;
    const bool is_there = random() % 3 != 0;
    const int rank = static_cast<int>(random() % ranks.size());
    if (!is_there) continue;
    all.push_back({3 * id, count});
    if (rank != ranks.rank()) continue;
    mine.insert(mine.begin(), 3 * id);  // in any order
    counts.insert(counts.begin(), count);
  }
  const auto sums = detail::sums_before(ranks, to_ids(mine), to_ids(counts));
  ASSERT_EQ(sums.places.extent(0), mine.size());
  GlobalId total = 0;
  for (const auto& [id, count] : all) {
    for (std::size_t i = 0; i < mine.size(); ++i) {
      if (mine[i] == id) EXPECT_EQ(sums.places(i), total) << id;
    }
    total += count;
  }
  EXPECT_EQ(sums.count, total);
}

TEST(SumsById, numbers_are_counted_on_all_ranks) {
  const Communicator ranks(MPI_COMM_WORLD, 100);
  std::mt19937 random(9);
  std::vector<GlobalId> mine, asked, expected(40, 0);
  for (int i = 0; i < 2000; ++i) {
    const GlobalId number = random() % 30;
    ++expected[number];
    if (static_cast<int>(random() % ranks.size()) == ranks.rank()) mine.push_back(number);
  }
  for (GlobalId number = 39; number >= ranks.rank() % 3; --number) asked.push_back(number);
  const Ids found = detail::occurrences(ranks, to_ids(mine), to_ids(asked));
  for (std::size_t i = 0; i < asked.size(); ++i) EXPECT_EQ(found(i), expected[asked[i]]) << asked[i];
}

/// Overlapping intervals, some inside others, some empty: what ranks know by themselves is what homes say.
TEST(VertexDirectory, of_intervals_says_what_that_of_any_ids_says) {
  const Communicator ranks(MPI_COMM_WORLD, 100);
  std::mt19937 random(3);
  for (int turn = 0; turn < 20; ++turn) {
    detail::IdInterval mine;
    for (int rank = 0; rank < ranks.size(); ++rank) {
      const GlobalId begin = random() % 60, count = random() % 4 == 0 ? 0 : random() % 40;
      if (rank == ranks.rank()) mine = {begin, begin + count};
    }
    std::vector<GlobalId> handed, asked;
    for (GlobalId id = mine.begin; id < mine.end; ++id) handed.push_back(id);
    for (GlobalId id = 0; id < 110; id += 1 + ranks.rank()) asked.push_back(id);
    const auto given = detail::GivenIntervals::of(ranks, detail::counted_interval(to_ids(handed)));
    ASSERT_TRUE(given);
    const Array<int, HostMemory> owners("owners", handed.size());
    Kokkos::deep_copy(owners, ranks.rank());
    const detail::VertexDirectory by_intervals(ranks, *given), by_homes(ranks, to_ids(handed), owners);
    EXPECT_EQ(by_intervals.vertices(), by_homes.vertices());
    const detail::OwnedVertices all_owned = by_intervals.owned(), all_expected = by_homes.owned();
    const detail::OwnedIds &owned = all_owned.ids, &expected = all_expected.ids;
    ASSERT_EQ(owned.count(), expected.count());
    EXPECT_EQ(owned.interval.begin, expected.interval.begin);
    EXPECT_EQ(owned.interval.end, expected.interval.end);
    ASSERT_EQ(owned.ids.extent(0), expected.ids.extent(0));
    for (std::size_t i = 0; i < owned.ids.extent(0); ++i) EXPECT_EQ(owned.ids(i), expected.ids(i));
    if (owned.interval.is_empty()) expect_equal(all_owned.entries, all_expected.entries);
    expect_equal(by_intervals.find(to_ids(asked)), by_homes.find(to_ids(asked)));
    for (Id i = 0; i < static_cast<Id>(handed.size()); ++i)
      EXPECT_EQ(by_intervals.owner_of_handed(i), by_homes.owner_of_handed(i)) << handed[i];
  }
}

/// The lowest rank that hands a vertex over says who owns it, and those who say otherwise are told; what a rank owns
/// comes from there.
TEST(VertexDirectory, tells_ranks_that_disagree_who_owns_what) {
  const Communicator ranks(MPI_COMM_WORLD, 100);
  std::mt19937 random(5);
  std::vector<std::vector<GlobalId>> handed(ranks.size());
  std::vector<std::vector<int>> owners(ranks.size());
  std::map<GlobalId, detail::VertexEntry> expected;
  for (int rank = 0; rank < ranks.size(); ++rank) {
    for (Id i = 0; i < 200; ++i) {
      handed[rank].push_back(random() % 300);  // some twice
      owners[rank].push_back(static_cast<int>(random() % ranks.size()));
      expected.try_emplace(handed[rank].back(), detail::VertexEntry{rank, i, owners[rank].back()});
    }
  }
  const std::vector<GlobalId>& mine = handed[ranks.rank()];
  const detail::VertexDirectory directory(ranks, to_ids(mine),
                                          Array<int, HostMemory>(owners[ranks.rank()].data(), mine.size()));
  for (Id i = 0; i < 200; ++i) EXPECT_EQ(directory.owner_of_handed(i), expected[mine[i]].owner) << mine[i];
  const detail::OwnedVertices owned = directory.owned();
  Offset at = 0;
  for (const auto& [id, entry] : expected) {
    if (entry.owner != ranks.rank()) continue;
    ASSERT_LT(at, owned.ids.count());
    EXPECT_EQ(owned.ids.interval.is_empty() ? owned.ids.ids(at) : owned.ids.interval.begin + at, id);
    EXPECT_EQ(owned.entries(at).giver, entry.giver) << id;
    EXPECT_EQ(owned.entries(at++).place, entry.place) << id;
  }
  EXPECT_EQ(at, owned.ids.count());
}

TEST(VertexDirectory, knows_no_intervals_where_one_rank_has_gaps) {
  const Communicator ranks(MPI_COMM_WORLD);
  const bool is_last = ranks.rank() + 1 == ranks.size();
  EXPECT_FALSE(detail::GivenIntervals::of(
      ranks, detail::counted_interval(to_ids(is_last ? std::vector<GlobalId>{1, 3} : std::vector<GlobalId>{4, 5}))));
}

}  // namespace gale::test
