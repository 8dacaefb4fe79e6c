#!/bin/bash
# Installs what a build needs, and configures it; enough alone on a bare Debian 12. Where nothing is there yet, the library,
# which needs a compiler and Kokkos alone, is compiled while the rest is installed.
#   usage: scripts/configure.sh PRESET FOLDER "PACKAGES" [CMAKE_OPTION...]
#     PRESET: of CMakePresets.json    FOLDER: its build folder    PACKAGES: what scripts/dependencies.sh is asked for
set -euo pipefail
cd "$(dirname "$0")/.."
preset=$1 folder=$2
read -ra packages <<<"$3"
shift 3
export CMAKE_GENERATOR=${CMAKE_GENERATOR:-Ninja} # of a new build folder; one that is there keeps its own

if [ ! -e "$folder" ] && ! scripts/dependencies.sh --are-there "${packages[@]}"; then
  scripts/dependencies.sh library
  trap 'rm -f "$folder/CMakeCache.txt"' EXIT # what is left out first is looked for again
  cmake --preset "$preset" -DGALE_ENABLE_{VTK,SYSTEM_LIBRARIES,LIBDEFLATE,APP,TESTS,EXAMPLES}=OFF
  nice cmake --build "$folder" --target gale --parallel "$(nproc)" &
  library=$!
  scripts/dependencies.sh "${packages[@]}" || { wait "$library" || :; exit 1; }
  wait "$library"
  rm "$folder/CMakeCache.txt"
  trap - EXIT
else
  scripts/dependencies.sh "${packages[@]}"
fi
cmake --preset "$preset" "$@"
