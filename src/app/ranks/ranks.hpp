#pragma once

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include <gale/app/session.hpp>
#include <gale/mesh/ranks.hpp>

// The command on several ranks, which a launcher such as mpirun has started it on. All that knows MPI is in this
// folder, and left out where gale is built without it: then it refuses to be started so.

namespace gale::app {

/// How this process was started: alone, or as one of several ranks. Initializes MPI where there are several, and ends
/// it.
class Launch {
 public:
  /// Throws gale::Error if there are several, and this gale has no MPI.
  Launch(int& argc, char**& argv);
  ~Launch();
  Launch(const Launch&) = delete;
  Launch& operator=(const Launch&) = delete;

  /// The ranks that this process is one of; Ranks::alone() without a launcher.
  static const Ranks& ranks();

  static bool are_several() { return ranks().size() > 1; }

  /// Whether this one speaks for all.
  static bool is_first() { return ranks().rank() == 0; }

  /// How many of the machine's threads one rank may take, of those that it would take alone.
  static int threads(int alone);

  /// Throws UsageError, on all ranks alike, if their command lines differ: each would wait for another one's steps.
  static void require_same_arguments(int argc, char** argv);

  /// Ends this process and, where others don't fail by themselves in the same way, them too. Returns where there is one
  /// alone.
  static void end_all(int code, bool all_fail_alike);

  /// Whether the exception that is being handled is one that all ranks throw alike.
  static bool all_fail_alike();
};

/// How many ranks a launcher says that it has started, of which this process is one; 1 without a launcher.
inline int launched_ranks() {
  int most = 1;
  for (const char* const name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}) {
    const char* const value = std::getenv(name);
    if (value != nullptr) most = std::max(most, std::atoi(value));
  }
  return most;
}

/// What of an input is wanted beside the mesh and the order: the field's values; points and all arrays, for outputs;
/// the cells' corners; and whether values of owned vertices will do.
struct WantedOfInput {
  bool values, arrays, cells;
  bool owned_will_do = false;
};

/// Reads an input on several ranks together: `grid:N` and `plane:N` are made by each rank for itself, the pieces of a
/// `.pvtu` are read by all ranks; else the first rank reads all. Calls was_read() with what is to be said of it, then
/// shares it: returns this rank's part of the mesh, and the field on it. Collective; throws SharedError.
FieldOnMesh read_on_ranks(const InputOptions& from, int capacity, const WantedOfInput& wanted,
                          const std::function<void(const std::vector<std::string>& notices)>& was_read);

}  // namespace gale::app
