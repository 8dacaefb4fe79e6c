#pragma once

#include <string>

#include <gale/algorithms/morse_smale.hpp>
#include <gale/app/options/options.hpp>
#include <gale/app/options/structure_option.hpp>

// The command on several ranks, which a launcher such as mpirun has started it on. All that knows MPI is in this
// folder, and left out where gale is built without it: then it refuses to be started so.

namespace gale::app {

/// The ranks that this process is one of; alone without a launcher. Initializes MPI where there are several, and ends
/// it.
class Ranks {
 public:
  /// Throws gale::Error if there are several, and this gale has no MPI.
  Ranks(int& argc, char**& argv);
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  static bool are_several();

  /// Whether this one speaks for all.
  static bool is_first();

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

/// gale critical-points on several ranks: `output` is empty or a .pvtp.
void critical_points_on_ranks(const InputOptions& input, const CommonOptions& common,
                              const SegmentationOptions& segmentation, const StructureOption& structure,
                              const std::string& output);

/// gale discrete-gradient on several ranks: `output` is empty or a .pvtp.
void discrete_gradient_on_ranks(const InputOptions& input, const CommonOptions& common,
                                const SegmentationOptions& segmentation, const StructureOption& structure,
                                const std::string& output);

/// gale morse-smale on several ranks, without walls: `prefix` is empty or what its files begin with.
void morse_smale_on_ranks(const InputOptions& input, const CommonOptions& common,
                          const SegmentationOptions& segmentation, const StructureOption& structure,
                          const MorseSmaleParts& wanted, const std::string& prefix);

}  // namespace gale::app
