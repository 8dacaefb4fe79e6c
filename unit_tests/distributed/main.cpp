#include <mpi.h>

#include <cstdlib>
#include <iostream>
#include <string>

#include <Kokkos_Core.hpp>
#include <gtest/gtest.h>

namespace {

/// Says what failed on a rank whose progress nobody wants to read.
class FailuresOf : public testing::EmptyTestEventListener {
 public:
  explicit FailuresOf(int rank) : rank_(rank) {}

  void OnTestPartResult(const testing::TestPartResult& result) override {
    if (!result.failed()) return;
    std::cerr << "rank " << rank_ << ": " << result.file_name() << ':' << result.line_number() << '\n'
              << result.message() << '\n';
  }

 private:
  int rank_;
};

/// Has GoogleTest run all tests on two ranks, but a fifth on one and on three and more, where all take minutes on two
/// cores: on 1, 3, 4 and 7 ranks different ones. All where GALE_WHOLE_BRAINS asks for what takes long, or as who starts
/// it chooses parts.
void choose_part(int ranks) {
  if (ranks == 2 || std::getenv("GALE_WHOLE_BRAINS") != nullptr) return;
  setenv("GTEST_TOTAL_SHARDS", "5", 0);
  setenv("GTEST_SHARD_INDEX", std::to_string(ranks / 2).c_str(), 0);
}

}  // namespace

int main(int argc, char** argv) {
  int provided = 0, rank = 0, ranks = 0, result = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  choose_part(ranks);
  testing::InitGoogleTest(&argc, argv);
  if (rank > 0) {
    auto& listeners = testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
    listeners.Append(new FailuresOf(rank));
  }
  {
    Kokkos::ScopeGuard kokkos(argc, argv);
    result = RUN_ALL_TESTS();
  }
  MPI_Finalize();
  return result;
}
