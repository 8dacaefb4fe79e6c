#pragma once

#include <gale/runtime/sweep_options.hpp>

namespace gale::test {

inline SweepOptions with_threads(int threads) {
  SweepOptions options;
  options.threads = threads;
  return options;
}

}  // namespace gale::test
