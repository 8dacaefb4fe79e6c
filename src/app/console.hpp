#pragma once

#include <functional>
#include <string>
#include <vector>

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

/// "1,732,840"
std::string grouped(std::int64_t number);

/// "0.593 s"
std::string seconds(double value);

/// "2.1 GiB"
std::string bytes(double value);

}  // namespace gale::app
