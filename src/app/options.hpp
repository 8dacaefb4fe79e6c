#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gale/io/atomic_file.hpp>
#include <gale/io/read.hpp>
#include <gale/outputs/persistence.hpp>
#include <gale/runtime/computation.hpp>

namespace CLI {
class App;
class Option;
}  // namespace CLI

// The groups of options that several commands have. Each adds its own to a command, which must outlive the parsing;
// its members hold what the command line says once that has been parsed.

namespace gale::app {

/// Wrong usage of the command: exit code 2. `what()` is the line to print.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Which steps of a series, counted from 0: those from `first` to `last`, which counts from the end where it is below
/// 0.
struct Times {
  std::int64_t first = 0, last = -1;
  std::string text = "all";  ///< as --times has it
};

/// What to read, and which of its arrays the command is about.
struct InputOptions {
  std::vector<std::string> inputs;  ///< one, or several that are the steps of a series
  std::string input;                ///< the one of these, or of what a series names, that is read
  std::optional<Times> times;       ///< which steps of a series; nothing where a command takes the first alone
  io::ReadOptions read;             ///< `read.array` is --array: the field's name, or empty
  std::optional<int> height;        ///< --height: the coordinate that is the field, 0 to 2

  void add_to(CLI::App& command);

  /// For commands that go through the steps of a series.
  void add_times_to(CLI::App& command);

  /// What to go through.
  struct Steps {
    bool are_series = false;  ///< whether the inputs are a series, of one step or more
    std::vector<io::Step> all;
    std::vector<std::string> not_chosen;  ///< the files of the others
  };

  /// The steps of a series that --times says, else the input, as it is. Throws gale::Error for a series that can't be
  /// read, UsageError where it hasn't such a step.
  Steps steps() const;
};

/// What every command has.
struct CommonOptions {
  std::optional<int> threads;  ///< all cores unless given
  std::string report;          ///< a file's name, or empty
  bool quiet = false;
  io::Encoding encoding = io::Encoding::appended;  ///< --encoding
  std::string extension;                           ///< --format: that of all its files, or empty

  void add_to(CLI::App& command);

  /// For commands that write VTK's XML files.
  void add_encoding_to(CLI::App& command);

  /// For commands that name their files themselves.
  void add_format_to(CLI::App& command);
};

/// How to divide the mesh's vertices into segments.
struct SegmentationOptions {
  std::optional<int> capacity;               ///< most vertices of the octree's leaves; not given: a default
  std::string array;                         ///< the point array that has the segments, or empty
  std::optional<std::int64_t> random_count;  ///< how many segments to make, by no rule

  void add_to(CLI::App& command);
};

/// --structure, which way to compute relations, the options that tune it, and --consumers.
struct StructureOption {
  ComputeOptions options;  ///< but for threads and progress

  void add_to(CLI::App& command);

  /// For commands whose consumers may be kernels.
  void add_consumers_to(CLI::App& command);

  /// Throws UsageError where --consumers asks for a device that isn't there, or that --structure has no use for. To be
  /// called before the work.
  void require_consumers() const;

  /// What --structure says: the name of a Way, or "task-parallel".
  std::string name = name_of(Way::gale);

  bool is_explicit() const { return options.structure.way == Way::explicit_; }

  /// The structure, preconditioned for `relations`.
  std::unique_ptr<Structure> make(const Mesh& mesh, RelationSet relations) const;
};

/// Adds --persistence X[%], which sets `persistence`.
void add_persistence(CLI::App& app, std::optional<outputs::Persistence>& persistence, const std::string& what);

}  // namespace gale::app
