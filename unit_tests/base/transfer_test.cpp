#include <atomic>
#include <numeric>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <gale/base/transfer.hpp>
#include <gale/base/types.hpp>

namespace gale::test {

namespace {

Array<Id, HostMemory> numbers(std::size_t count) {
  const Array<Id, HostMemory> array("numbers", count);
  std::iota(array.data(), array.data() + count, 7);
  return array;
}

}  // namespace

TEST(Transfer, there_and_back_keeps_every_entry) {
  constexpr std::size_t mebi = 1 << 20;  // 4 MiB: where copies may be divided
  for (const std::size_t count : {std::size_t(0), std::size_t(1), mebi - 1, mebi, mebi + 1, 9 * mebi + 5}) {
    const auto there = on_worker(numbers(count));
    ASSERT_EQ(there.extent(0), count);
    const auto back = on_host(there);
    ASSERT_EQ(back.extent(0), count);
    std::size_t different = 0;
    for (std::size_t i = 0; i < count; ++i) different += back(i) != static_cast<Id>(7 + i);
    EXPECT_EQ(different, 0u) << "of " << count;
  }
}

TEST(Transfer, goes_in_pieces_through_pinned_memory) {
  constexpr std::size_t mebi = 1 << 20;  // which pieces have
  prepare_copies(3);
  for (const std::size_t count : {std::size_t(0), std::size_t(1), mebi / 4 + 1, mebi / 2, 5 * mebi + 3}) {
    const auto from = numbers(count), back = numbers(count);
    const auto there = allocate<Array<Id, WorkerMemory>>("there", count);
    Kokkos::deep_copy(back, 0);
    copy_to_device(there.data(), from.data(), count * sizeof(Id));
    copy_from_device(back.data(), there.data(), count * sizeof(Id));
    std::size_t different = 0;
    for (std::size_t i = 0; i < count; ++i) different += back(i) != from(i);
    EXPECT_EQ(different, 0u) << "of " << count;
  }
}

TEST(Transfer, of_many_threads_keeps_what_each_has_apart) {
  constexpr std::size_t count = 700'000, bytes = count * sizeof(Id);
  std::atomic<std::size_t> different{0};
  const auto copy = [&](int thread) {
    const auto from = allocate<Array<Id, HostMemory>>("from", count);
    const auto back = allocate<Array<Id, HostMemory>>("back", count);
    const auto there = allocate<Array<Id, WorkerMemory>>("there", count);
    for (std::size_t i = 0; i < count; ++i) from(i) = static_cast<Id>(thread * count + i);
    copy_to_device(there.data(), from.data(), bytes);
    detail::copy_meanwhile(back.data(), there.data(), bytes);
    for (std::size_t i = 0; i < count; ++i) different += back(i) != from(i);
  };
  std::vector<std::thread> threads;
  for (int thread = 0; thread < 24; ++thread) threads.emplace_back(copy, thread);
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(different, 0u);
}

TEST(Transfer, a_write_that_fails_leaves_the_next_as_it_should_be) {
  constexpr std::size_t count = 3 << 20, bytes = count * sizeof(Id);
  const auto there = allocate<Array<Id, WorkerMemory>>("there", count);
  const auto write_but = [&](std::size_t refused) {
    write_to_device(there.data(), bytes, [&](char* to, std::size_t begin, std::size_t size) {
      EXPECT_EQ(begin % (1 << 20), 0u);
      if (begin == refused) throw Error("refused");
      for (std::size_t i = 0; i < size / sizeof(Id); ++i)
        reinterpret_cast<Id*>(to)[i] = static_cast<Id>(begin / sizeof(Id) + i);
    });
  };
  EXPECT_THROW(write_but(5 << 20), Error);
  write_but(bytes);
  const auto back = on_host(there);
  std::size_t different = 0;
  for (std::size_t i = 0; i < count; ++i) different += back(i) != static_cast<Id>(i);
  EXPECT_EQ(different, 0u);
}

TEST(Transfer, of_rows_of_four) {
  const Kokkos::View<Id* [4], Kokkos::LayoutRight, HostMemory> rows("rows", 3);
  for (int i = 0; i < 12; ++i) rows(i / 4, i % 4) = i;
  const auto back = on_host(on_worker(Kokkos::View<const Id* [4], Kokkos::LayoutRight, HostMemory>(rows)));
  for (int i = 0; i < 12; ++i) EXPECT_EQ(back(i / 4, i % 4), i);
}

TEST(Transfer, copies_nothing_that_is_there_already) {
  const auto array = numbers(5);
  EXPECT_EQ(on_host(array).data(), array.data());
  EXPECT_EQ(on_worker(array).data() == array.data(), !have_device);
}

}  // namespace gale::test
