#include <algorithm>
#include <atomic>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <gale/algorithms/excerpt/numbered_set.hpp>
#include <gale/algorithms/excerpt/shared_set.hpp>
#include <gale/algorithms/excerpt/vertex_names.hpp>
#include <gale/base/threads.hpp>

/// Sets that threads fill side by side, and the names of vertices that come from several ranks.
namespace gale::test {

TEST(NumberedSet, numbers_what_threads_add_side_by_side) {
  const Id places = 100000;
  std::mt19937 random(5);
  std::vector<Id> added(3 * places / 2);
  for (Id& place : added) place = static_cast<Id>(random() % places);
  const std::set<Id> expected(added.begin(), added.end());
  detail::NumberedSet set(places);
  std::atomic<Id> is_new{0};
  in_turns(4, static_cast<std::int64_t>(added.size()), [&](int, std::int64_t i) {
    if (set.insert(added[i])) ++is_new;
  });
  EXPECT_EQ(is_new, static_cast<Id>(expected.size()));
  set.number();
  ASSERT_EQ(set.count(), static_cast<Id>(expected.size()));
  Id number = 0;
  for (const Id place : expected) EXPECT_EQ(set[place], number++);
  std::vector<Id> member(set.count(), no_id);
  set.for_each("visit", [&](Id place, Id at) { member[at] = place; });
  EXPECT_TRUE(std::equal(member.begin(), member.end(), expected.begin(), expected.end()));
  for (Id place = 0; place < places; ++place) ASSERT_EQ(set.has(place), expected.count(place) == 1);
}

TEST(SharedSet, takes_each_key_once_whoever_adds_it) {
  const int keys = 20000, times = 5;
  detail::SharedSet set;
  std::vector<std::atomic<int>> is_new(keys);
  std::set<int> parts;
  for (Id k = 0; k < keys; ++k) parts.insert(detail::SharedSet::part_of(pair_key(k, k + 7)));
  EXPECT_EQ(parts.size(), static_cast<std::size_t>(detail::SharedSet::parts));  // nobody waits for all others
  in_turns(4, std::int64_t(keys) * times, [&](int, std::int64_t i) {
    const Id k = static_cast<Id>(i % keys);
    if (set.insert(pair_key(k, k + 7))) ++is_new[k];
  });
  for (int k = 0; k < keys; ++k) ASSERT_EQ(is_new[k], 1) << k;
}

/// Own vertices with these global ids, ascending, and others: names and keys against where all stand.
void expect_names(const std::vector<GlobalId>& own, const std::vector<GlobalId>& others) {
  std::vector<GlobalId> all = own;
  all.insert(all.end(), others.begin(), others.end());
  std::vector<GlobalId> sorted = all;
  std::sort(sorted.begin(), sorted.end());
  const auto place = [](const auto& in, GlobalId id) {
    return static_cast<Id>(std::lower_bound(in.begin(), in.end(), id) - in.begin());
  };
  const Id count = static_cast<Id>(own.size());
  std::vector<Id> input, own_before;  // GALE's ids are the input's backwards
  for (Id v = 0; v < count; ++v) input.push_back(count - 1 - v);
  for (const GlobalId id : others) own_before.push_back(place(own, id));
  const auto first = std::upper_bound(own_before.begin(), own_before.end(), 0),
             last = std::lower_bound(first, own_before.end(), count);
  const detail::VertexNames names{
      {input.data()},
      count,
      own_before.data(),
      {static_cast<Id>(first - own_before.begin()), static_cast<Id>(last - own_before.begin())}};
  std::vector<std::uint64_t> own_keys, others_keys;
  for (Id v = 0; v < count; ++v) own_keys.push_back(std::uint64_t(3) << 32 | static_cast<std::uint32_t>(input[v]));
  for (Id i = 0; i < static_cast<Id>(others.size()); ++i)
    others_keys.push_back(std::uint64_t(3) << 32 | static_cast<std::uint32_t>(names[count + i]));
  const detail::NamedKeys keys{own_keys.data(), count, others_keys.data(), names};
  for (Id v = 0; v < static_cast<Id>(all.size()); ++v) {
    const GlobalId id = v < count ? own[input[v]] : all[v];
    EXPECT_EQ(names[v], place(sorted, id)) << v;
    EXPECT_EQ(keys[v], std::uint64_t(3) << 32 | static_cast<std::uint64_t>(place(sorted, id))) << v;
  }
}

TEST(VertexNames, are_places_among_all_vertices_wherever_others_come) {
  expect_names({4, 5, 6}, {});
  expect_names({}, {1, 2});
  expect_names({4, 5, 6}, {1, 2});
  expect_names({4, 5, 6}, {7, 9});
  expect_names({4, 5, 6}, {1, 7});
  expect_names({4, 6, 8, 20}, {1, 5, 7, 9, 10, 30});
  expect_names({4, 6, 8}, {5, 7});
}

TEST(VertexNames, compare_own_keys_as_they_are_where_there_are_no_names) {
  const std::vector<std::uint64_t> ranks{2, 0, 1};
  const detail::NamedKeys keys{ranks.data(), 3};
  for (Id v = 0; v < 3; ++v) EXPECT_EQ(keys[v], ranks[v]);
}

}  // namespace gale::test
