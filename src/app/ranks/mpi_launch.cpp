#include <mpi.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <optional>
#include <string>
#include <thread>

#include <gale/app/machine.hpp>
#include <gale/app/ranks/ranks.hpp>
#include <gale/distributed/communicator.hpp>

namespace gale::app {

namespace {

int ranks_of_machine = 1;
std::optional<Communicator> communicator;  // where there are several

/// Joins all arguments, each with a 0 behind it, which none can have in it.
std::string joined(int argc, char** argv) {
  std::string all;
  for (int i = 1; i < argc; ++i) all.append(argv[i]).push_back('\0');
  return all;
}

/// The argument of `joined` ones that begins at `at`, as it is said.
std::string argument(const std::string& joined, std::size_t at) {
  return at < joined.size() ? "'" + std::string(joined.c_str() + at) + "'" : "nothing more";
}

/// Has OpenMPI start with what ranks of one machine need, where all are on one: to try libraries for networks takes it
/// 0.2 s, and to look through the machine's devices 0.07, more than all else of its start. OpenMPI 4 copies through
/// shared memory then, as some containers forbid to read another process's; 5 finds out by itself. Keeps what the
/// environment or mpirun's arguments say of `pml`, and of hwloc's components.
void start_soon_on_one_machine() {
  const char* const all = std::getenv("OMPI_COMM_WORLD_SIZE");
  const char* const here = std::getenv("OMPI_COMM_WORLD_LOCAL_SIZE");
  if (all == nullptr || here == nullptr || std::strcmp(all, here) != 0 || std::getenv("OMPI_MCA_pml") != nullptr)
    return;
  setenv("OMPI_MCA_pml", "ob1", 0);
  setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 0);
  setenv("HWLOC_COMPONENTS", "-pci,-linuxio,-opencl,-gl", 0);
}

/// Waits for all ranks before MPI ends, which would hold the core for as long as that takes.
void end_mpi() {
  if (communicator) communicator->least(std::int64_t(0));
  communicator.reset();
  int initialized = 0;
  MPI_Initialized(&initialized);
  if (initialized) MPI_Finalize();
}

}  // namespace

Launch::Launch(int& argc, char**& argv) {
  if (launched_ranks() == 1) return;
  start_soon_on_one_machine();
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  int count = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  if (count == 1) return;
  keep_freed_memory();  // what ranks exchange comes and goes; peaks grow by 2 % at most
  communicator.emplace(MPI_COMM_WORLD);
  MPI_Comm machine;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, communicator->rank(), MPI_INFO_NULL, &machine);
  MPI_Comm_size(machine, &ranks_of_machine);
  MPI_Comm_free(&machine);
}

Launch::~Launch() { end_mpi(); }

const Ranks& Launch::ranks() { return communicator ? *communicator : Ranks::alone(); }

int Launch::threads(int alone) {
  // A rank that the launcher has bound to some cores has them for itself.
  const bool is_bound = alone < static_cast<int>(std::thread::hardware_concurrency());
  return is_bound ? alone : std::max(alone / ranks_of_machine, 1);
}

void Launch::require_same_arguments(int argc, char** argv) {
  if (!are_several()) return;
  const int count = ranks().size();
  const std::string mine = joined(argc, argv), first = ranks().broadcast(mine, 0);
  const auto other = static_cast<int>(ranks().least(std::int64_t(mine == first ? count : ranks().rank())));
  if (other == count) return;
  const std::string theirs = ranks().broadcast(mine, other);
  std::size_t at = 0;  // where the first argument that differs begins
  for (std::size_t i = 0; i < theirs.size() && i < first.size() && theirs[i] == first[i]; ++i) {
    if (first[i] == '\0') at = i + 1;
  }
  throw UsageError("all ranks take the same arguments: rank " + std::to_string(other) + " has " + argument(theirs, at) +
                   " where rank 0 has " + argument(first, at));
}

void Launch::end_all(int code, bool all_fail_alike) {
  if (!are_several()) return;
  if (!all_fail_alike) MPI_Abort(MPI_COMM_WORLD, code);
  MPI_Finalize();
}

bool Launch::all_fail_alike() {
  if (!are_several()) return true;
  if (!std::current_exception()) return false;
  try {
    throw;
  } catch (const SharedError&) {
    return true;
  } catch (const UsageError&) {  // every rank has the same command line
    return true;
  } catch (...) {
    return false;
  }
}

}  // namespace gale::app
