#pragma once

#include <stdexcept>
#include <string>

#include <gale/export.hpp>

namespace gale {

/// What every failure on the host throws. `what()` is one line that names the value at fault.
class GALE_EXPORT Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Memory ran out. `what()` says of which kind, how much and for what.
class GALE_EXPORT OutOfMemory : public Error {
 public:
  /// `missing` is what there was none of, e.g. "HostSpace has no 80 bytes for GALE::tetrahedra".
  explicit OutOfMemory(const std::string& missing) : Error(prefix + missing) {}

  /// what() without its beginning, "out of memory: ".
  std::string missing() const { return what() + std::char_traits<char>::length(prefix); }

 private:
  static constexpr const char* prefix = "out of memory: ";
};

}  // namespace gale
