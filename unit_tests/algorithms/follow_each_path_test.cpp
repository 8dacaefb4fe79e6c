#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <gale/algorithms/excerpt/path_steps.hpp>
#include <gale/algorithms/gradient/follow_each_path.hpp>
#include <gale/algorithms/morse_smale/condensed_paths.hpp>

namespace gale::test {

namespace {

/// Successors of `count` simplices, lower ones, and below 0 where a path ends: here and there, in all ways.
Array<Id, HostMemory> falling_successors(Id count) {
  const auto successors = allocate<Array<Id, HostMemory>>("successors", count);
  std::mt19937 random(11);
  for (Id i = 0; i < count; ++i)
    successors(i) = i == 0 || random() % 50 == 0 ? -1 - static_cast<Id>(random() % 3) : static_cast<Id>(random() % i);
  return successors;
}

void expect_end(const Array<Id, HostMemory>& successors, Id start, Id last, Id next) {
  Id at = start;
  while (successors(at) >= 0) at = successors(at);
  ASSERT_EQ(last, at) << "from " << start;
  ASSERT_EQ(next, successors(at)) << "from " << start;
}

}  // namespace

TEST(FollowEachPath, comes_to_the_end_of_each_once) {
  const Id count = 30000;
  const auto successors = falling_successors(count);
  const Array<const Id, HostMemory> made(successors);
  for (const Mirrored<Id>& where : {Mirrored<Id>(made), Mirrored<Id>(on_worker(made))}) {
    for (const Id paths : {0, 1, 5, 16, 17, 20000}) {
      std::vector<Id> last(paths, no_id), next(paths, 0), calls(paths, 0);
      const auto start = [&](Offset i) { return static_cast<Id>(count - 1 - i); };
      detail::follow_each_path("paths", where, paths, start, [&](Offset i, Id at, Id behind) {
        ++calls[i];
        last[i] = at;
        next[i] = behind;
      });
      for (Id i = 0; i < paths; ++i) {
        ASSERT_EQ(calls[i], 1);
        expect_end(successors, start(i), last[i], next[i]);
      }
    }
  }
}

TEST(FollowEachPath, comes_there_in_each_memory) {
  const Id count = 30000;
  const auto successors = falling_successors(count);
  const auto follow = [&](const auto& space, Id paths) {
    const auto starts = iota("starts", HostExecutionSpace(), paths);
    const auto there = in_memory<MemoryOf<std::decay_t<decltype(space)>>>(Array<const Id, HostMemory>(successors));
    const detail::PathStops stops = detail::follow_in(space, "paths", there, starts);
    ASSERT_EQ(stops.last.extent(0), static_cast<std::size_t>(paths));
    for (Id i = 0; i < paths; ++i) expect_end(successors, starts(i), stops.last(i), stops.next(i));
  };
  for (const Id paths : {0, 1, 20000}) {
    follow(HostExecutionSpace(), paths);
    follow(WorkerSpace(), paths);
  }
}

TEST(FollowPaths, tells_each_simplex_on_the_way_and_what_follows_in_each_memory) {
  const Id count = 30000;
  const auto successors = falling_successors(count);
  const auto follow = [&](const auto& space, Id paths) {
    std::vector<Id> starts;
    for (Id i = 0; i < paths; ++i) starts.push_back(count - 1 - i);
    const auto there = in_memory<MemoryOf<std::decay_t<decltype(space)>>>(Array<const Id, HostMemory>(successors));
    const detail::SteppedPaths found = detail::step_along_paths(space, there, starts);
    std::size_t at = 0;
    for (const Id start : starts) {
      for (Id cell = start; cell >= 0; cell = successors(cell), ++at) {
        ASSERT_LT(at, found.simplices.extent(0));
        ASSERT_EQ(found.simplices(at), cell);
        ASSERT_EQ(found.next(at), successors(cell));
      }
    }
    ASSERT_EQ(at, found.simplices.extent(0));
  };
  for (const Id paths : {0, 1, 20000}) {
    follow(HostExecutionSpace(), paths);
    follow(WorkerSpace(), paths);
  }
}

TEST(CondensedPaths, end_where_paths_of_all_simplices_do_in_each_memory) {
  const Id count = 30000;
  const auto successors = falling_successors(count);
  std::vector<Id> ends, place(count, no_id);
  for (Id i = 0; i < count; ++i) {
    if (successors(i) != no_id) continue;
    place[i] = static_cast<Id>(ends.size());
    ends.push_back(i);
  }
  const Mirrored<Id> given = Array<const Id, HostMemory>(successors);
  const auto follow = [&](const auto& space, Id paths) {
    std::mt19937 random(3);
    const auto first = allocate<Array<Id, HostMemory>>("first", paths);  // some of them twice, some none
    for (Id i = 0; i < paths; ++i) first(i) = i % 7 == 0 ? no_id : static_cast<Id>(random() % count);
    using Memory = MemoryOf<std::decay_t<decltype(space)>>;
    const Array<Id, Memory> starts = allocate<Array<Id, Memory>>("starts", paths);
    Kokkos::deep_copy(starts, first);
    const auto next = detail::condensed_paths(space, given, ends, starts).next;
    ASSERT_LE(next.extent(0), paths + ends.size());
    detail::jump(space, next);
    space.fence();
    const auto entries = on_host(Array<const Id, Memory>(starts)), last = on_host(Array<const Id, Memory>(next));
    for (Id i = 0; i < paths; ++i) {
      if (first(i) == no_id) {
        ASSERT_EQ(entries(i), no_id);
        continue;
      }
      Id at = first(i);
      while (successors(at) >= 0) at = successors(at);
      ASSERT_EQ(detail::place_of_end(last(entries(i))), place[at]) << "from " << first(i);
    }
  };
  for (const Id paths : {0, 1, 20000}) {
    follow(HostExecutionSpace(), paths);
    follow(WorkerSpace(), paths);
  }
}

TEST(CondensedPaths, end_at_exits_behind_the_ends_from_whatever_simplex_they_are_asked) {
  const Id count = 30000, paths = 5000;
  const auto successors = falling_successors(count);
  std::vector<Id> ends, exits, expected(count), all(count);
  for (Id i = 0; i < count; ++i) {
    if (successors(i) == no_id) ends.push_back(i);
    if (successors(i) == -3) exits.push_back(i);
    all[i] = i;
  }
  ASSERT_GT(exits.size(), 100u);
  for (std::size_t i = 0; i < ends.size(); ++i) expected[ends[i]] = static_cast<Id>(i);
  for (std::size_t i = 0; i < exits.size(); ++i) expected[exits[i]] = static_cast<Id>(ends.size() + i);
  for (Id i = 0; i < count; ++i) {  // successors are lower
    if (successors(i) >= 0) expected[i] = expected[successors(i)];
    if (successors(i) == -2) expected[i] = no_id;
  }
  const Mirrored<Id> given = Array<const Id, HostMemory>(successors);
  const auto follow = [&](const auto& space) {
    using Memory = MemoryOf<std::decay_t<decltype(space)>>;
    const auto in_space = [](const std::vector<Id>& ids) {
      const auto copy = allocate<Array<Id, Memory>>("ids", ids.size());
      Kokkos::deep_copy(copy, Array<const Id, HostMemory>(ids.data(), ids.size()));
      return copy;
    };
    const auto found =
        detail::condensed_paths(space, given, ends, in_space({all.end() - paths, all.end()}), in_space(exits));
    ASSERT_LT(found.next.extent(0), static_cast<std::size_t>(count) / 2);
    detail::jump(space, found.next);
    space.fence();
    const detail::EndOfPath<Memory> end{found.next, found.words, found.before, given.in<Memory>()};
    EXPECT_EQ(detail::results_at("ends", space, all, end), expected);
  };
  follow(HostExecutionSpace());
  follow(WorkerSpace());
}

}  // namespace gale::test
