#include <atomic>
#include <numeric>
#include <thread>

#include <gtest/gtest.h>

#include <gale/base/memory.hpp>
#include <gale/base/mirrored.hpp>
#include <gale/base/momentary.hpp>
#include <gale/base/types.hpp>

#include "support/arrays.hpp"

namespace gale::test {

namespace {

std::vector<Id> numbers() {
  std::vector<Id> values(1000);
  std::iota(values.begin(), values.end(), 7);
  return values;
}

}  // namespace

TEST(Mirrored, has_no_entries_until_it_is_given_some) {
  const Mirrored<Id> empty;
  EXPECT_EQ(empty.size(), 0u);
  EXPECT_FALSE(empty.on_device());
  EXPECT_EQ(empty.in<HostMemory>().extent(0), 0u);
}

TEST(Mirrored, is_the_array_where_it_was_made_and_equal_where_it_was_not) {
  const auto made = to_worker(numbers());
  const Mirrored<Id> worker(made), host(on_host(made));
  EXPECT_EQ(worker.size(), 1000u);
  EXPECT_EQ(worker.on_device(), have_device);
  EXPECT_FALSE(host.on_device());
  EXPECT_EQ(worker.in<WorkerMemory>().data(), made.data());
  EXPECT_EQ(to_vector(worker), numbers());
  EXPECT_EQ(to_vector(host.in<WorkerMemory>()), numbers());
  EXPECT_EQ(to_vector(host.in<HostMemory>()), numbers());
}

TEST(Mirrored, tells_some_entries_wherever_it_was_made) {
  const auto made = iota("made", HostExecutionSpace(), 100);
  for (const Mirrored<Id>& where : {Mirrored<Id>(made), Mirrored<Id>(on_worker(made))}) {
    EXPECT_EQ(detail::entries_at(where, {99, 0, 42, 0}), (std::vector<Id>{99, 0, 42, 0}));
    EXPECT_TRUE(detail::entries_at(where, {}).empty());
  }
}

TEST(Mirrored, copies_share_what_was_copied) {
  const Mirrored<Id> one(to_worker(numbers()));
  const Mirrored<Id> other = one;
  const Id* const first = other.in<HostMemory>().data();
  EXPECT_EQ(one.in<HostMemory>().data(), first);
  EXPECT_EQ(one.in<HostMemory>().data(), first) << "once";
}

TEST(Mirrored, is_on_the_host_once_however_often_it_is_brought_there) {
  const auto made = to_worker(numbers());
  for (const Mirrored<Id>& array : {Mirrored<Id>(made), Mirrored<Id>(on_host(made)), Mirrored<Id>()}) {
    const Mirrored<Id> other = array;
    array.bring_to_host();
    other.bring_to_host();
    const Id* const there = array.in<HostMemory>().data();
    EXPECT_EQ(to_vector(other.in<HostMemory>()), array.size() == 0 ? std::vector<Id>() : numbers());
    array.bring_to_host();
    EXPECT_EQ(other.in<HostMemory>().data(), there);
  }
  Mirrored<Id>(to_worker(numbers())).bring_to_host();  // nobody asks for it
}

TEST(Mirrored, is_copied_once_by_whichever_thread_comes_first) {
  const Mirrored<Id> array(to_worker(numbers()));
  constexpr int count = 8;
  std::vector<const Id*> seen(count);
  std::vector<std::thread> threads;
  for (int i = 0; i < count; ++i) threads.emplace_back([&, i] { seen[i] = array.in<HostMemory>().data(); });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(seen, std::vector<const Id*>(count, seen[0]));
}

TEST(Once, happens_again_only_if_it_threw) {
  detail::Once once;
  int calls = 0;
  EXPECT_THROW(once([&] {
                 ++calls;
                 throw OutOfMemory("nothing left");
               }),
               OutOfMemory);
  for (int i = 0; i < 3; ++i) once([&] { ++calls; });
  EXPECT_EQ(calls, 2);
}

TEST(WorkerOrHost, calls_the_host_if_there_is_no_room_on_a_device) {
  std::vector<bool> on_device;
  const auto f = [&](const auto& space) {
    on_device.push_back(is_device<std::decay_t<decltype(space)>>);
    if (on_device.back()) throw OutOfMemory("the device has no 8 bytes for a test");
    return 7;
  };
  std::string missing;
  const int result = in_worker_or_host_space(true, f, [&](const OutOfMemory& error) { missing = error.missing(); });
  EXPECT_EQ(result, 7);
  EXPECT_EQ(on_device, have_device ? (std::vector<bool>{true, false}) : std::vector<bool>{false});
  EXPECT_EQ(missing, have_device ? "the device has no 8 bytes for a test" : "");
  on_device.clear();
  EXPECT_EQ(in_worker_or_host_space(false, f), 7);
  EXPECT_EQ(on_device, std::vector<bool>{false});
}

TEST(OutOfMemory, is_an_error_that_says_what_is_missing) {
  try {
    allocate<Array<Id, HostMemory>>("GALE::test", std::size_t(1) << 60);
    ADD_FAILURE() << "there is that much";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "out of memory: Host has no 4611686018427387904 bytes for GALE::test");
    EXPECT_EQ(dynamic_cast<const OutOfMemory&>(error).missing(),
              "Host has no 4611686018427387904 bytes for GALE::test");
  }
}

}  // namespace gale::test
