#pragma once

#include <stdexcept>

namespace gale::app {

/// Wrong usage of the command: exit code 2. `what()` is the line to print.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace gale::app
