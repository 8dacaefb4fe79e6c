#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>

#include <gale/algorithms/morse_smale.hpp>
#include <gale/app/persistence.hpp>
#include <gale/baselines/oracle.hpp>
#include <gale/io/read.hpp>
#include <gale/outputs/field.hpp>
#include <gale/runtime/structure_options.hpp>

namespace gale::app {

using namespace outputs;
using namespace baselines;

/// Wrong usage: exit code 2. `what()` is the line to print.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What the command line says.
struct Options {
  std::string command;
  std::string input;
  io::ReadOptions read;
  std::string output;
  std::string arrows;     ///< of `gale discrete-gradient`: the file for the gradient's arrows, or empty
  MorseSmaleParts parts;  ///< of `gale morse-smale`
  std::optional<Persistence> persistence;  ///< likewise: what to simplify to
  std::string render;                      ///< likewise: the picture, or empty
  std::string array;
  std::string segments;            ///< a point array's name, or empty
  std::optional<int> capacity;     ///< 100 unless given
  std::optional<int> threads;      ///< all cores unless given
  std::string structure = "gale";  ///< gale, explicit, inline or task-parallel
  StructureOptions runtime;
  std::string formulation = "stars";  ///< of `gale discrete-gradient`: stars or cells
  std::string relation;               ///< of `gale relations`: the name of one of the sixteen
  bool verify = false;                ///< likewise: compare with an oracle
  std::string dump;                   ///< likewise: the file for all rows, or empty
  std::string report;
  bool quiet = false;
};

/// Parses the command line. Nothing if it only asked for help or the version, which are printed then. Throws
/// UsageError.
std::optional<Options> parse_command_line(int argc, char** argv);

}  // namespace gale::app
