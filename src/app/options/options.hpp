#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <gale/io/atomic_file.hpp>
#include <gale/io/read.hpp>

namespace CLI {
class App;
}

// The groups of options that several commands have. Each adds its own to a command, which must outlive the parsing;
// its members hold what the command line says once that has been parsed.

namespace gale::app {

/// What to read, and which of its arrays the command is about.
struct InputOptions {
  std::string input;
  io::ReadOptions read;  ///< `read.array` is --array: the field's name, or empty

  void add_to(CLI::App& command);
};

/// What every command has.
struct CommonOptions {
  std::optional<int> threads;  ///< all cores unless given
  std::string report;          ///< a file's name, or empty
  bool quiet = false;
  io::Encoding encoding = io::Encoding::appended;  ///< --encoding

  void add_to(CLI::App& command);

  /// For commands that write VTK's XML files.
  void add_encoding_to(CLI::App& command);
};

/// How to divide the mesh's vertices into segments.
struct SegmentationOptions {
  std::optional<int> capacity;               ///< of the octree's leaves; not given: a default
  std::string array;                         ///< the point array that has the segments, or empty
  std::optional<std::int64_t> random_count;  ///< so many segments, by no rule

  void add_to(CLI::App& command);
};

}  // namespace gale::app
