#include <vector>

#include <gtest/gtest.h>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/io/synthetic.hpp>
#include <gale/mesh/make_mesh.hpp>

/// The only program here that doesn't initialize Kokkos.
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

namespace gale::test {

namespace {

template <class Call>
void expect_told(const Call& call) {
  try {
    call();
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "Kokkos is not initialized: call Kokkos::initialize or make a Kokkos::ScopeGuard before using GALE");
  }
}

}  // namespace

TEST(Uninitialized, meshes_are_refused) {
  const std::vector<double> points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const std::vector<int> tetrahedra = {0, 1, 2, 3};
  expect_told([&] { make_mesh(points, tetrahedra); });
}

TEST(Uninitialized, grids_are_refused) {
  expect_told([] { io::make_grid(3); });
}

TEST(Uninitialized, arrays_are_refused) {
  expect_told([] { allocate<Array<Id, HostMemory>>("test", 7); });
  expect_told([] { allocate<Array<Id, WorkerMemory>>("test", 7); });
}

TEST(Uninitialized, loops_are_refused) {
  if (KOKKOS_VERSION >= 50000) GTEST_SKIP() << "Kokkos 5 makes no execution space before it is initialized";
  int calls = 0;
  expect_told([&] { parallel_for("test", HostExecutionSpace(), 3, [&](Offset) { ++calls; }); });
  expect_told([&] { reduce_sum("test", HostExecutionSpace(), 3, [](Offset) { return 1; }); });
  EXPECT_EQ(calls, 0);
}

}  // namespace gale::test
