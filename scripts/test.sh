#!/bin/bash
# Builds GALE in build/ and runs all tests: enough alone on a bare Debian 12.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/configure.sh ci build "data mpi" -DGALE_ENABLE_VTK_FILTERS=ON -DGALE_ENABLE_MPI=ON -DGALE_ENABLE_TTK=ON \
  -DGALE_ENABLE_EXAMPLES=OFF # the tests build them against an install
cmake --build --preset ci --parallel "$(nproc)"
ctest --preset ci --no-tests=error --parallel 3 # those on ranks wait more than they compute
