#include <algorithm>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include <gale/base/parallel.hpp>
#include <gale/base/thread_stack.hpp>
#include <gale/base/transfer.hpp>

namespace gale::test {

namespace {

/// Pushes i, 100 + i, ... and pops the last; appends what is left.
struct PushSome {
  Array<Id, WorkerMemory> list, popped;
  Array<Offset, WorkerMemory> count;

  KOKKOS_FUNCTION void operator()(Offset i) const {
    detail::ThreadStack<Id, 4> stack;
    for (Id k = 0; k < i % 5; ++k) stack.push(static_cast<Id>(100 * k + i));
    popped(i) = stack.is_empty() ? no_id : stack.pop();
    stack.append_to(list, &count(0));
  }
};

}  // namespace

TEST(ThreadStack, has_the_latest_first_and_appends_what_is_left) {
  const PushSome push{allocate<Array<Id, WorkerMemory>>("list", 120), allocate<Array<Id, WorkerMemory>>("popped", 100),
                      Array<Offset, WorkerMemory>("count", 1)};
  parallel_for("push", WorkerSpace(), 100, push);
  Kokkos::fence();
  std::vector<Id> list = vector_of(push.list), expected;
  const std::vector<Id> popped = vector_of(push.popped);
  for (Id i = 0; i < 100; ++i) {
    EXPECT_EQ(popped[i], i % 5 == 0 ? no_id : 100 * (i % 5 - 1) + i);
    for (Id k = 0; k + 1 < i % 5; ++k) expected.push_back(100 * k + i);
  }
  ASSERT_EQ(on_host(push.count)(0), 120);
  std::sort(list.begin(), list.end());
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(list, expected);
}

}  // namespace gale::test
