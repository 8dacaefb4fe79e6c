#pragma once

#include <stdexcept>

namespace gale {

/// What every failure on the host throws. `what()` is one line that names the value at fault.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace gale
