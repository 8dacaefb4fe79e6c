#include <mpi.h>

#include <algorithm>
#include <exception>
#include <thread>

#include <gale/app/ranks/launched_ranks.hpp>
#include <gale/app/ranks/ranks.hpp>
#include <gale/app/usage_error.hpp>
#include <gale/distributed/communicator.hpp>

namespace gale::app {

namespace {

int count = 1, rank = 0, ranks_of_machine = 1;

}  // namespace

Ranks::Ranks(int& argc, char**& argv) {
  if (launched_ranks() == 1) return;
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm machine;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, rank, MPI_INFO_NULL, &machine);
  MPI_Comm_size(machine, &ranks_of_machine);
  MPI_Comm_free(&machine);
}

Ranks::~Ranks() {
  int initialized = 0;
  MPI_Initialized(&initialized);
  if (initialized) MPI_Finalize();
}

bool Ranks::are_several() { return count > 1; }
bool Ranks::is_first() { return rank == 0; }

int Ranks::threads(int alone) {
  // A rank that the launcher has bound to some cores has them for itself.
  const bool is_bound = alone < static_cast<int>(std::thread::hardware_concurrency());
  return is_bound ? alone : std::max(alone / ranks_of_machine, 1);
}

void Ranks::end_all(int code, bool all_fail_alike) {
  if (count == 1) return;
  if (!all_fail_alike) MPI_Abort(MPI_COMM_WORLD, code);
  MPI_Finalize();
}

bool Ranks::all_fail_alike() {
  if (count == 1) return true;
  if (!std::current_exception()) return false;
  try {
    throw;
  } catch (const SharedError&) {
    return true;
  } catch (const UsageError&) {  // of one command line
    return true;
  } catch (...) {
    return false;
  }
}

}  // namespace gale::app
