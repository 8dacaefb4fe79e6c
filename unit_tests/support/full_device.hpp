#pragma once

#include <vector>

#include <gale/base/error.hpp>
#include <gale/base/memory.hpp>

namespace gale::test {

inline constexpr std::size_t mebi = std::size_t(1) << 20;

/// Takes a device's memory while it lives, but for some of it.
class FullDevice {
 public:
  explicit FullDevice(std::size_t free) {
    for (std::size_t size = std::size_t(1) << 40; size >= mebi; size /= 2) {
      while (take(size)) {
      }
    }
    std::size_t freed = 0;
    while (freed < free && !taken_.empty()) {
      freed += taken_.back().extent(0);
      taken_.pop_back();
    }
    while (freed >= free + mebi && take(mebi)) freed -= mebi;  // what was given back too much
  }

 private:
  bool take(std::size_t size) {
    try {
      taken_.push_back(allocate<Array<char, WorkerMemory>>("test_ballast", size));
      return true;
    } catch (const OutOfMemory&) {
      return false;
    }
  }

  std::vector<Array<char, WorkerMemory>> taken_;  ///< the smallest last
};

}  // namespace gale::test
