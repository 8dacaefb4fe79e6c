#include <algorithm>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <gale/base/error.hpp>
#include <gale/distributed/sharing/cell_places.hpp>
#include <gale/distributed/sharing/id_interval.hpp>
#include <gale/distributed/sharing/local_vertices.hpp>

#include "support/arrays.hpp"

namespace gale::test {

namespace {

detail::GlobalIds array_of(const std::vector<GlobalId>& ids) {
  const detail::GlobalIds array("ids", ids.size());
  std::copy(ids.begin(), ids.end(), array.data());
  return array;
}

/// What a map of all says.
void expect_places(const detail::LocalVertices& found, const std::set<GlobalId>& owned,
                   const std::set<GlobalId>& ghosts) {
  std::set<GlobalId> all = owned;
  all.insert(ghosts.begin(), ghosts.end());
  ASSERT_EQ(found.count(), static_cast<Offset>(all.size()));
  Id v = 0;
  Offset own = 0, ghost = 0;
  for (const GlobalId id : all) {
    EXPECT_EQ(found.id(v), id);
    EXPECT_EQ(found.find(id), v);
    EXPECT_EQ(found.find(id + 1), all.count(id + 1) > 0 ? v + 1 : no_id);
    if (owned.count(id) > 0) {
      EXPECT_EQ(found.owned(own++), v);
    } else {
      EXPECT_EQ(found.ghost_number(v), ghost);
      EXPECT_EQ(found.ghost(ghost++), v);
    }
    ++v;
  }
  EXPECT_EQ(found.owned_count(), own);
  EXPECT_EQ(found.ghost_count(), ghost);
}

/// A cell's id, and where it comes from: its place in the part, or -1 - its place among the received ones.
using Sources = std::map<GlobalId, Offset>;

void expect_sources(const detail::CellPlaces& places, const Sources& expected) {
  ASSERT_EQ(places.count(), static_cast<Offset>(expected.size()));
  const auto ids = places.ids();
  std::vector<Offset> sources;
  Offset i = 0;
  for (const auto& [id, source] : expected) {
    EXPECT_EQ(places.id(i), id);
    EXPECT_EQ(ids(i), id);
    sources.push_back(source);
    ++i;
  }
  for (const Offset first : {Offset(0), places.count() / 3, places.count()}) {
    Offset next = first;
    const auto meet = [&](Offset i, Offset source) {
      EXPECT_EQ(i, next++);
      EXPECT_EQ(source, sources[i]);
    };
    places.visit(
        first, places.count(),
        [&](Offset i, Offset place, Offset count) {
          for (Offset k = 0; k < count; ++k) meet(i + k, place + k);
        },
        [&](Offset i, Offset r) { meet(i, -1 - r); });
    EXPECT_EQ(next, places.count());
  }
}

}  // namespace

TEST(KeepDistinct, sorts_dense_and_sparse_ids) {
  std::mt19937_64 random(7);
  for (const GlobalId stride : {GlobalId(1), GlobalId(1) << 40}) {
    std::vector<GlobalId> ids;
    for (int i = 0; i < 5000; ++i) ids.push_back(11 + stride * static_cast<GlobalId>(random() % 3000));
    const std::set<GlobalId> expected(ids.begin(), ids.end());
    detail::keep_distinct(ids);
    EXPECT_EQ(ids, std::vector<GlobalId>(expected.begin(), expected.end()));
  }
  std::vector<GlobalId> none;
  detail::keep_distinct(none);
  EXPECT_TRUE(none.empty());
}

TEST(IndexInterval, contains_what_the_interval_does) {
  constexpr GlobalId last = std::numeric_limits<std::int32_t>::max();
  const std::vector<GlobalId> ids = {-last - 1, -1, 0, 1, 6, 7, 8, 99, 100, last - 1, last};
  for (const GlobalId begin : {GlobalId(0), GlobalId(7), last - 1, last, last + 1}) {
    for (const GlobalId end : {GlobalId(0), GlobalId(8), GlobalId(100), last, last + 1, 4 * last}) {
      const detail::IdInterval interval{begin, end};
      const detail::IndexInterval<std::int32_t> narrow(interval);
      const detail::IndexInterval<std::int64_t> wide(interval);
      for (const GlobalId id : ids) {
        EXPECT_EQ(narrow.contains(static_cast<std::int32_t>(id)), interval.contains(id)) << id << ' ' << begin;
        EXPECT_EQ(wide.contains(id), interval.contains(id)) << id << ' ' << begin;
        const std::int64_t three[] = {begin, id, begin};
        EXPECT_EQ(wide.contains(three, 3), interval.contains(id) && interval.contains(begin)) << id << ' ' << begin;
      }
      EXPECT_TRUE(wide.contains(nullptr, 0));
    }
  }
}

TEST(LocalVertices, of_an_interval_with_ghosts_on_both_sides) {
  const detail::OwnedIds owned(detail::IdInterval{100, 140});
  for (const std::vector<GlobalId>& ghosts :
       {std::vector<GlobalId>{}, {3, 99}, {140, 141, 1000}, {0, 50, 99, 140, GlobalId(1) << 40}}) {
    std::set<GlobalId> mine;
    for (GlobalId id = 100; id < 140; ++id) mine.insert(id);
    expect_places(detail::LocalVertices(owned, array_of(ghosts)), mine, {ghosts.begin(), ghosts.end()});
  }
}

TEST(LocalVertices, of_ids_with_gaps) {
  std::mt19937_64 random(5);
  std::set<GlobalId> owned, ghosts;
  for (int i = 0; i < 400; ++i) (random() % 2 == 0 ? owned : ghosts).insert(static_cast<GlobalId>(random() % 5000));
  for (const GlobalId id : owned) ghosts.erase(id);
  const detail::OwnedIds ids(array_of({owned.begin(), owned.end()}));
  EXPECT_TRUE(ids.interval.is_empty());
  expect_places(detail::LocalVertices(ids, array_of({ghosts.begin(), ghosts.end()})), owned, ghosts);
  expect_places(detail::LocalVertices(detail::OwnedIds(), array_of({4, 9})), {}, {4, 9});
  expect_places(detail::LocalVertices(), {}, {});
}

/// Kept ones counted from an id or with ids of their own, that ascend or don't; all of the part or some; and received
/// ones anywhere among them.
TEST(CellPlaces, are_by_ascending_ids) {
  std::mt19937_64 random(9);
  constexpr Offset count = 300;
  for (int turn = 0; turn < 12; ++turn) {
    const bool counted = turn % 3 == 0, ascending = turn % 3 == 1;
    std::vector<GlobalId> of_part;
    for (Offset t = 0; t < count; ++t) of_part.push_back(counted ? 1000 + t : 10 * t);
    if (!counted && !ascending) std::shuffle(of_part.begin(), of_part.end(), random);
    Sources expected;
    std::vector<Id> kept;
    for (Offset t = 0; t < count; ++t) {
      if (turn >= 6 && random() % 4 == 0) continue;
      kept.push_back(static_cast<Id>(t));
      expected[of_part[t]] = t;
    }
    std::vector<GlobalId> received;
    for (int r = 0; r < 20 * (turn % 2); ++r) {
      const GlobalId id = counted ? (r < 10 ? r : 2000 + r) : 10 * static_cast<GlobalId>(random() % 4000) + 5;
      if (expected.count(id) > 0) continue;
      expected[id] = -1 - static_cast<Offset>(received.size());
      received.push_back(id);
    }
    detail::KeptCells mine;
    mine.count = static_cast<Offset>(kept.size());
    mine.first_id = 1000;
    if (!counted) mine.ids = array_of(of_part);
    if (mine.count < count) {
      const Array<Id, HostMemory> places("places", kept.size());
      std::copy(kept.begin(), kept.end(), places.data());
      mine.places = places;
    }
    expect_sources(detail::CellPlaces(mine, array_of(received)), expected);
  }
}

TEST(CellPlaces, refuse_an_id_that_occurs_twice) {
  detail::KeptCells kept;
  kept.count = 5;
  kept.first_id = 10;
  for (const std::vector<GlobalId>& received : {std::vector<GlobalId>{12}, {40, 40}, {8, 14}}) {
    const GlobalId twice = received.back();
    try {
      const detail::CellPlaces places(kept, array_of(received));
      FAIL() << twice;
    } catch (const Error& error) {
      EXPECT_EQ(error.what(), "cell " + std::to_string(twice) + " is handed over twice");
    }
  }
}

}  // namespace gale::test
