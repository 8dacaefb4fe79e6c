#pragma once

#include <DataTypes.h>

#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "support/seconds.hpp"

// What TTK's modules are given and what they gave. Nothing of GALE's or Kokkos', so that what the device's compiler
// refuses may be compiled without it.

namespace gale::perf {

/// The greatest memory that this process has had.
inline double peak_megabytes() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word != "VmHWM:") continue;
    double kilobytes = 0;
    status >> kilobytes;
    return kilobytes / 1000;
  }
  return 0;
}

/// What a part of the work took: seconds, those of all processors, and the peak of memory when it was done.
struct Took {
  double seconds = 0, processors = 0, peak = 0;

  template <class Work>
  void time(const Work& work) {
    const double before = processor_seconds();
    seconds = seconds_of(work);
    processors = processor_seconds() - before;
    peak = peak_megabytes();
  }
};

/// What a module gave, as named arrays of numbers, and what it took.
struct ModuleResult {
  std::vector<std::pair<std::string, std::vector<double>>> arrays;
  Took precondition, run;

  template <class Values>
  void add(const std::string& name, const Values& values) {
    arrays.emplace_back(name, std::vector<double>(values.begin(), values.end()));
  }
};

/// The fields that modules read: values, and the vertices' ranks by value and number.
struct Fields {
  std::vector<float> values;
  std::vector<::ttk::SimplexId> order;
  int threads = 1;
};

/// Has a module print nothing, and take so many threads.
template <class Module>
void prepare(Module& module, int threads) {
  module.setDebugLevel(0);
  module.setThreadNumber(threads);
}

}  // namespace gale::perf
