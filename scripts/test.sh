#!/bin/bash
# Builds GALE in build/ and runs all tests: enough alone on a bare Debian 12. Where nothing is there yet, the library, which
# needs a compiler and Kokkos alone, is compiled while the rest is installed.
set -euo pipefail
cd "$(dirname "$0")/.."
export CMAKE_GENERATOR=${CMAKE_GENERATOR:-Ninja} # of a new build folder; one that is there keeps its own

packages=(data mpi)
if [ ! -e build ] && ! scripts/dependencies.sh --are-there "${packages[@]}"; then
  scripts/dependencies.sh library
  trap 'rm -f build/CMakeCache.txt' EXIT # what is left out first is looked for again
  cmake --preset ci -DGALE_ENABLE_{VTK,LIBDEFLATE,APP,TESTS,EXAMPLES}=OFF
  nice cmake --build build --target gale --parallel "$(nproc)" &
  library=$!
  scripts/dependencies.sh "${packages[@]}" || { wait $library || :; exit 1; }
  wait $library
  rm build/CMakeCache.txt
  trap - EXIT
else
  scripts/dependencies.sh "${packages[@]}"
fi
cmake --preset ci -DGALE_ENABLE_VTK_FILTERS=ON -DGALE_ENABLE_MPI=ON -DGALE_ENABLE_TTK=ON \
  -DGALE_ENABLE_EXAMPLES=OFF # the tests build them against an install
cmake --build --preset ci --parallel "$(nproc)"
ctest --preset ci --no-tests=error --parallel 3 # those on ranks wait more than they compute
