#pragma once

#include <cstddef>

namespace gale::fuzz {

/// While it lives, memory that this program allocates is filled with a byte, counted, and refused beyond a limit. Does
/// nothing in a build with the address sanitizer, which has the program's allocations for itself. One at a time.
class MemoryWatch {
 public:
  MemoryWatch(unsigned char fill, std::size_t limit);
  ~MemoryWatch();
  MemoryWatch(const MemoryWatch&) = delete;
  MemoryWatch& operator=(const MemoryWatch&) = delete;

  /// The most that was allocated at once.
  static std::size_t peak();

  /// Whether something was refused.
  static bool refused();

  static bool works();
};

}  // namespace gale::fuzz
