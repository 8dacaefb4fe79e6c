#pragma once

#include <algorithm>
#include <cstdlib>

namespace gale::app {

/// How many ranks a launcher says that it has started, of which this process is one; 1 without a launcher.
inline int launched_ranks() {
  int most = 1;
  for (const char* const name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}) {
    const char* const value = std::getenv(name);
    if (value != nullptr) most = std::max(most, std::atoi(value));
  }
  return most;
}

}  // namespace gale::app
