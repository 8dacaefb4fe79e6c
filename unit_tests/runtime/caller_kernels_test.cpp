#include <mutex>
#include <set>
#include <thread>

#include <gtest/gtest.h>

#include <gale/base/atomic.hpp>
#include <gale/base/team.hpp>
#include <gale/runtime/device_sweep.hpp>
#include <gale/runtime/graph_of.hpp>
#include <gale/runtime/make_structure.hpp>

#include "support/input_mesh.hpp"
#include "support/segmentations.hpp"

// What runs a caller's code keeps the promises of the space that the caller named: a count that all rows of a mesh add
// to, entry by entry, is right by Kokkos' atomics in a space of Kokkos', and by GALE's in every space.

namespace gale::test {

namespace {

/// Kokkos' atomics, or ours.
struct AddByKokkos {
  KOKKOS_FUNCTION static void add(Offset* to) { Kokkos::atomic_add(to, Offset(1)); }
};
struct AddByGale {
  KOKKOS_FUNCTION static void add(Offset* to) { atomic_add(to, 1); }
};

/// Adds so many for each entry of a row, and of a segment's rows, one by one: long enough for threads to meet.
template <class By, class Memory>
struct CountEntries {
  static constexpr int times = 20;
  Relation relation;
  Kokkos::View<Offset, Memory> count;

  KOKKOS_FUNCTION void operator()(Id, const Row& row) const {
    for (Id i = 0; i < times * row.size(); ++i) By::add(count.data());
  }
  template <class Team, class Segment>
  KOKKOS_FUNCTION void operator()(const Team& team, const Segment& segment) const {
    const Rows rows = segment[relation];
    team::for_all(team, rows.count, [&](int i) { (*this)(rows.first + i, rows[rows.first + i]); });
  }
};

template <class Memory>
Offset value_of(const Kokkos::View<Offset, Memory>& count) {
  return Kokkos::create_mirror_view_and_copy(HostMemory(), count)();
}

/// Threads that called it.
struct Callers {
  static std::mutex mutex;
  static std::set<std::thread::id> threads;

  void operator()(Id, const Row&) const { note(); }
  template <class Team, class Segment>
  void operator()(const Team&, const Segment&) const {
    note();
  }
  static void note() {
    const std::lock_guard<std::mutex> lock(mutex);
    threads.insert(std::this_thread::get_id());
  }
};
std::mutex Callers::mutex;
std::set<std::thread::id> Callers::threads;

/// Several threads, however few cores there are.
class CallerKernels : public testing::Test {
 protected:
  static void SetUpTestSuite() { set_host_threads(8); }
  static void TearDownTestSuite() { set_host_threads(before); }

  template <class By, class Space>
  void expect_counts(const Space& space) const {
    using Memory = detail::MemoryOfSweep<Space>;
    for (const Relation relation : {Relation::EF, Relation::VT}) {
      const Offset all = CountEntries<By, Memory>::times * graph_of(space, mesh, relation).entries.extent(0);
      const CountEntries<By, Memory> by_row{relation, Kokkos::View<Offset, Memory>("by_row")};
      for_each_row(space, mesh, relation, by_row);
      EXPECT_EQ(value_of(by_row.count), all) << name_of(relation);
      const CountEntries<By, Memory> by_segment{relation, Kokkos::View<Offset, Memory>("by_segment")};
      for_each_segment(space, mesh, relation, by_segment);
      EXPECT_EQ(value_of(by_segment.count), all) << name_of(relation);
    }
  }

  static const int before;
  const Mesh mesh = encode(holed_grid(20), 50);
};
const int CallerKernels::before = host_threads();

TEST_F(CallerKernels, count_by_the_atomics_of_the_space) {
  expect_counts<AddByKokkos>(Kokkos::DefaultExecutionSpace());
  expect_counts<AddByKokkos>(Kokkos::DefaultHostExecutionSpace());
#if defined(KOKKOS_ENABLE_SERIAL)
  expect_counts<AddByKokkos>(Kokkos::Serial());
#endif
}

TEST_F(CallerKernels, count_by_our_atomics_in_every_space) {
  expect_counts<AddByGale>(Kokkos::DefaultExecutionSpace());
  expect_counts<AddByGale>(Kokkos::DefaultHostExecutionSpace());
  expect_counts<AddByGale>(HostThreads());
}

TEST_F(CallerKernels, count_by_our_atomics_in_sweeps_of_a_structure) {
  Offset count = 0;
  const CountEntries<AddByGale, HostMemory> add{Relation::EF, Kokkos::View<Offset, HostMemory>(&count)};
  make_structure(mesh, Relation::EF)->for_each_segment(Relation::EF, {}, [&](int, const SegmentRows& rows) {
    add(HostTeam(0, nullptr), rows);
  });
  EXPECT_EQ(count, Offset(add.times * graph_of(HostThreads(), mesh, Relation::EF).entries.extent(0)));
}

#if defined(KOKKOS_ENABLE_SERIAL)
TEST_F(CallerKernels, run_on_one_thread_in_Serial) {
  Callers::threads.clear();
  for_each_row(Kokkos::Serial(), mesh, Relation::VV, Callers());
  for_each_segment(Kokkos::Serial(), mesh, Relation::VV, Callers());
  EXPECT_EQ(Callers::threads, std::set<std::thread::id>{std::this_thread::get_id()});
}
#endif

TEST_F(CallerKernels, run_on_no_more_threads_than_the_space_has) {
  Callers::threads.clear();
  const Kokkos::DefaultHostExecutionSpace space;
  for_each_row(space, mesh, Relation::VV, Callers());
  for_each_segment(space, mesh, Relation::VV, Callers());
  EXPECT_LE(Callers::threads.size(), std::size_t(space.concurrency()));
}

/// The scratch memory of a team is its own.
struct FillScratch {
  static constexpr int words = 1000;
  Kokkos::View<Offset, HostMemory> wrong;

  template <class Team, class Segment>
  void operator()(const Team& team, const Segment& segment) const {
    auto* const own = reinterpret_cast<Id*>(team::scratch<0>(team, words * sizeof(Id)));
    team::for_all(team, words, [&](int i) { own[i] = segment.segment(); });
    team::barrier(team);
    for (int i = 0; i < words; ++i) {
      if (own[i] != segment.segment()) atomic_add(wrong.data(), 1);
    }
  }
};

TEST_F(CallerKernels, have_scratch_memory_of_their_own) {
  DeviceSweepOptions options;
  options.team_scratch = FillScratch::words * sizeof(Id) + 16;
  const FillScratch fill{Kokkos::View<Offset, HostMemory>("wrong")};
  for_each_segment(HostThreads(), mesh, Relation::VV, fill, options);
  for_each_segment(Kokkos::DefaultHostExecutionSpace(), mesh, Relation::VV, fill, options);
  EXPECT_EQ(fill.wrong(), 0);
}

}  // namespace

}  // namespace gale::test
