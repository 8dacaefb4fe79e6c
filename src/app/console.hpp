#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include <gale/base/error.hpp>
#include <gale/base/types.hpp>

namespace gale::app {

/// What the user sees while a command works: results on standard output, the progress of sweeps on a terminal.
class Console {
 public:
  explicit Console(bool quiet) : quiet_(quiet) {}

  /// Prints one line: a name, padded, and a value. Nothing when quiet. Throws gale::Error if that doesn't arrive.
  void say(const std::string& name, const std::string& value) const;

  /// For SweepOptions::progress: on a terminal a function that draws a bar with this title, elsewhere none. The bar is
  /// erased when all is done, or when the last copy of the function goes.
  std::function<void(Id done, Id all)> progress(const std::string& title) const;

 private:
  bool quiet_;
};

/// Throws gale::Error, with the system's reason, unless all that was printed has arrived: a disk may be full, a
/// descriptor closed.
void require_output();

/// Says what the command does from now on, for an error that doesn't say where it happened.
void begin_step(const char* doing, const std::string& what = {});

/// Everything was written: what fails now is only tidying up.
void end_steps();
bool steps_ended();

/// What was begun last: "reading 'mesh.vtu'".
const char* current_step();

using detail::grouped;

/// "0.593 s"
std::string seconds(double value);

/// "2.1 GiB"
std::string bytes(double value);

/// What std::printf() makes of a number, in `format`, and of a unit if that has room for one.
std::string formatted(const char* format, double value, const char* unit = "");

}  // namespace gale::app
