#pragma once

#include <memory>
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

/// An input that several ranks read together. Its functions are collective, and throw SharedError.
class SharedField {
 public:
  /// Reads: `grid:N` is made by each rank for itself, the pieces of a `.pvtu` are read by all ranks; else the first
  /// rank reads all, and the others have nothing.
  explicit SharedField(const InputOptions& input);
  ~SharedField();

  /// What is to be said of it.
  const std::vector<std::string>& notices() const;

  /// What of the input outputs take.
  struct Wanted {
    bool arrays, tetrahedra;
  };

  /// This rank's part of the mesh, and the field on it. Forgets what was read.
  FieldOnMesh share(int capacity, const Wanted& wanted);

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace gale::app
