#pragma once

#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <gale/io/atomic_file.hpp>
#include <gale/io/read.hpp>
#include <gale/mesh/mesh.hpp>
#include <gale/mesh/ranks.hpp>
#include <gale/runtime/structure.hpp>

namespace gale::app {

/// How many seconds the parts of a command took. `total` counts from the mesh in memory to the result in memory.
struct Seconds {
  double read = 0, segment = 0, initialize = 0, run = 0, write = 0;
  double total() const { return segment + initialize + run; }
};

/// What lies between the two.
inline Seconds operator-(const Seconds& now, const Seconds& before) {
  return {now.read - before.read, now.segment - before.segment, now.initialize - before.initialize,
          now.run - before.run, now.write - before.write};
}

/// What the clock says of a command beside these: `start` from the process's start until it began with its input, and
/// of `Seconds::write` what went into bytes, compressed and handed to the system, and what waited for them on disk.
struct WallClock {
  double start = 0, compress = 0, store = 0;
};

using gale::detail::Stopwatch;

/// What `make` makes, whose time is added to `seconds`.
template <class Make>
auto timed(double& seconds, const Make& make) {
  const Stopwatch watch(seconds);
  return make();
}

/// What `--report` writes; the README has the schema.
struct Report {
  std::string input;
  int threads = 0;
  std::optional<std::string> structure, way, consumers;
  std::optional<std::int64_t> vertices, edges, triangles, tetrahedra, segments;
  std::vector<std::string> notices;  ///< one line each about what was left out or done differently, and why
  Seconds seconds;
  WallClock wall;
  std::optional<StructureStatistics> statistics;
  nlohmann::ordered_json ranks;  ///< what differs between ranks; null on one
  nlohmann::ordered_json result = nlohmann::ordered_json::object();
  nlohmann::ordered_json steps;  ///< of a series: time, input, seconds and result of each; null for another input

  /// Takes the result for that of a step, which took so long.
  void add_step(const io::Step& step, const Seconds& took);
};

nlohmann::ordered_json to_json(const Report& report);

/// Puts into the report how the structure worked, and how many edges and triangles it had to enumerate; not its
/// notices.
void report_structure(const Structure& structure, Report& report);

/// What differs between ranks: how much of the mesh each has as its part, took, sent and waited; of each the least, the
/// median and the most. Collective.
nlohmann::ordered_json differences_of_ranks(const Ranks& ranks, const Mesh& part, const Seconds& seconds);

/// Writes what `write` puts out to the temporary of `file`. Throws gale::Error, naming the file, with the system's
/// reason, as soon as something can't be written; whatever `write` throws, too.
void write_text(const io::AtomicFile& file, const std::function<void(std::ostream&)>& write);

/// Writes a table to the temporary of `file`, in the format of its extension. Throws gale::Error, naming the file.
void write_table(const io::AtomicFile& file, const std::vector<io::PointArray>& columns);

/// Writes the report to the temporary of `file`. Throws gale::Error, naming the file.
void write_report(const io::AtomicFile& file, const Report& report);

}  // namespace gale::app
