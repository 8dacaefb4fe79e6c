#include <utility>

#include <gtest/gtest.h>

#include <gale/base/launch_chain.hpp>
#include <gale/base/transfer.hpp>

namespace gale::test {

namespace {

struct HalvingCounts {
  Offset open = 0;
  Offset ones = 0;
  detail::LaunchPart part;
};

/// Halves numbers until there are ones alone, which it counts: each step of a thread leaves one half open.
struct Halve {
  Array<Id, WorkerMemory> numbers;
  Array<HalvingCounts, WorkerMemory> counts;

  KOKKOS_FUNCTION detail::LaunchPart& part() const { return counts(0).part; }
  KOKKOS_FUNCTION Offset open() const { return counts(0).open; }
  KOKKOS_FUNCTION Offset room() const { return static_cast<Offset>(numbers.extent(0)) - counts(0).open; }

  KOKKOS_FUNCTION void go_on(Offset i, int steps) const {
    Id number = numbers(i);
    for (int step = 0; step < steps && number > 1; ++step) {
      leave(number / 2);
      number -= number / 2;
    }
    if (number == 1) {
      atomic_add(&counts(0).ones, Offset(1));
    } else {
      leave(number);
    }
  }

  /// Leaves a number open; one for which there is no room is lost.
  KOKKOS_FUNCTION void leave(Id number) const {
    const Offset place = atomic_add(&counts(0).open, Offset(1));
    if (place < static_cast<Offset>(numbers.extent(0))) numbers(place) = number;
  }
};

constexpr Id number = 5000;

/// A list that has the number alone.
Halve begin(Offset room) {
  const Halve halve{allocate<Array<Id, WorkerMemory>>("numbers", room),
                    allocate<Array<HalvingCounts, WorkerMemory>>("counts", 1)};
  fill("numbers", WorkerSpace(), halve.numbers, number);
  fill("counts", WorkerSpace(), halve.counts, HalvingCounts{1, 0, {}});
  return halve;
}

HalvingCounts go_on(const Halve& halve, Offset open) {
  detail::launch_chain("halve", WorkerSpace(), open, halve);
  WorkerSpace().fence();
  return vector_of(halve.counts)[0];
}

}  // namespace

TEST(LaunchChain, goes_on_from_what_its_launches_leave_open) {
  const Halve halve = begin(100000);
  HalvingCounts counts = go_on(halve, 1);
  EXPECT_GT(counts.ones, 0) << "it takes several launches to come to the first one";
  if (counts.open > counts.part.end) counts = go_on(halve, counts.open - counts.part.end);
  EXPECT_EQ(counts.open, counts.part.end) << "two chains are more than enough";
  EXPECT_EQ(counts.ones, number);
}

TEST(LaunchChain, waits_where_there_is_no_room_and_loses_nothing) {
  Halve halve = begin(50);
  HalvingCounts counts{1, 0, {}};
  int waits = 0;
  while (counts.open > counts.part.end) {
    const HalvingCounts before = counts;
    counts = go_on(halve, counts.open - counts.part.end);
    ASSERT_LE(counts.open, static_cast<Offset>(halve.numbers.extent(0)));
    if (counts.part.end > before.part.end) continue;
    ASSERT_LT(++waits, 20) << "there is room for all";
    const auto larger = allocate<Array<Id, WorkerMemory>>("numbers", 2 * halve.numbers.extent(0));
    Kokkos::deep_copy(Kokkos::subview(larger, std::make_pair(std::size_t(0), halve.numbers.extent(0))), halve.numbers);
    halve.numbers = larger;
  }
  EXPECT_GT(waits, 0);
  EXPECT_EQ(counts.ones, number);
}

}  // namespace gale::test
