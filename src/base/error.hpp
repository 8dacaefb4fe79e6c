#pragma once

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include <gale/base/types.hpp>
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

/// Throws gale::Error if so many of what `name` says, e.g. "edges", are more than an Id counts.
inline void require_ids(const char* name, Offset count) {
  if (count <= std::numeric_limits<Id>::max()) return;
  throw Error(std::to_string(count) + ' ' + name + " are too many: ids have 32 bits, at most 2147483647 fit");
}

namespace detail {

/// "1,732,840": a count as people read it.
inline std::string grouped(std::int64_t number) {
  std::string digits = std::to_string(number);
  for (int at = static_cast<int>(digits.size()) - 3; at > (number < 0 ? 1 : 0); at -= 3)
    digits.insert(static_cast<std::size_t>(at), ",");
  return digits;
}

}  // namespace detail

}  // namespace gale
