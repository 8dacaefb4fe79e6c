#!/bin/bash
# Installs what GALE is built from on Debian 12 with apt; does nothing when all is there.
#   usage: scripts/dependencies.sh [--are-there] [library | command] [data] [drawing] [format] [rendering] [releases] [python] [docs] [mpi] [clang] [plots]
#     --are-there: installs nothing, and says by its exit code whether all is there
#     library: what this takes alone, instead of what all that GALE is takes    command: what the command takes, without VTK and Kokkos-Kernels
#     data: brain volumes    drawing: VTK for Python, without a screen    format: clang-format    rendering: without a screen
#     releases: what scripts/test-releases.sh needs    python: to build the module    docs: the site    mpi: for several ranks
#     clang: the other compiler    plots: pictures of measurements
set -euo pipefail

are_there=
if [ "${1-}" = --are-there ]; then
  are_there=yes
  shift
fi
packages=(cmake g++ ninja-build libtrilinos-kokkos-dev)
kernels=libtrilinos-kokkos-kernels-dev
rendering=(libgl1-mesa-dri xvfb xauth)
case "${1-}" in
  library) packages+=("$kernels"); shift ;;
  command) packages+=(libcli11-dev nlohmann-json3-dev libdeflate-dev libexpat1-dev liblz4-dev liblzma-dev zlib1g-dev); shift ;;
  *) packages+=("$kernels" libvtk9-dev libcli11-dev nlohmann-json3-dev libgtest-dev libdeflate-dev python3) ;;
esac
for more in "$@"; do
  case "$more" in
    data) packages+=(mricron-data) ;;
    drawing) packages+=(python3-vtk9 python3-numpy "${rendering[@]}") ;;
    format) packages+=(clang-format) ;;
    rendering) packages+=("${rendering[@]}") ;;
    releases) packages+=(debootstrap) ;;
    python) packages+=(python3-dev python3-venv) ;;
    docs) packages+=(doxygen python3-venv) ;;
    mpi) packages+=(libopenmpi-dev) ;;
    clang) packages+=(clang-14 libomp-14-dev libclang-rt-14-dev llvm-14) ;;
    plots) packages+=(python3-matplotlib) ;;
    *) sed -n 's/^#   usage: /usage: /p' "$0" >&2; exit 2 ;;
  esac
done

missing=()
for package in "${packages[@]}"; do
  [ "$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0
[ ! "$are_there" ] || exit 1

as_root=(env DEBIAN_FRONTEND=noninteractive)
[ "$(id -u)" = 0 ] || as_root=(sudo "${as_root[@]}")
"${as_root[@]}" apt-get update
"${as_root[@]}" apt-get install --yes --no-install-recommends "${missing[@]}"
