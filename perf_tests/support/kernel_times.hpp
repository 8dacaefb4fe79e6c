#pragma once

#include <map>
#include <string>

namespace gale::perf {

/// What Kokkos' kernels, copies and fences took, by label, while one of these lives: seconds by the host's clock, from
/// begin to end, and of this process's processors meanwhile. Loops of GALE's own host threads are among them.
class KernelTimes {
 public:
  struct Entry {
    double seconds = 0;
    double processor_seconds = 0;
    long count = 0;
  };

  KernelTimes();
  ~KernelTimes();
  KernelTimes(const KernelTimes&) = delete;
  KernelTimes& operator=(const KernelTimes&) = delete;

  std::map<std::string, Entry> entries() const;

  /// Prints them, the longest first.
  void print() const;
};

}  // namespace gale::perf
