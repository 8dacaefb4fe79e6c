#!/bin/bash
# Installs what GALE is built from on Debian 12 with apt; does nothing when all is there.
#   usage: scripts/dependencies.sh library | --are-there | [data] [format] [rendering] [releases] [python] [docs] [mpi] [clang] [plots]
#     library: for this alone    --are-there: installs nothing, and says whether what all builds need is there
#     data: brain volumes    format: clang-format    rendering: without a screen    releases: what scripts/test-releases.sh needs    python: to build the module
#     docs: the site    mpi: for several ranks    clang: the other compiler    plots: pictures of measurements
set -euo pipefail

packages=(cmake g++ ninja-build python3 libtrilinos-kokkos-dev libtrilinos-kokkos-kernels-dev)
only=
if [ $# = 1 ] && [[ $1 = library || $1 = --are-there ]]; then
  only=$1
  shift
fi
[ "$only" = library ] || packages+=(libvtk9-dev libcli11-dev nlohmann-json3-dev libgtest-dev libdeflate-dev)
for more in "$@"; do
  case "$more" in
    data) packages+=(mricron-data) ;;
    format) packages+=(clang-format) ;;
    rendering) packages+=(libgl1-mesa-dri xvfb xauth) ;;
    releases) packages+=(debootstrap) ;;
    python) packages+=(python3-dev python3-venv) ;;
    docs) packages+=(doxygen python3-venv) ;;
    mpi) packages+=(libopenmpi-dev) ;;
    clang) packages+=(clang-14 libomp-14-dev libclang-rt-14-dev llvm-14) ;;
    plots) packages+=(python3-matplotlib) ;;
    *) echo "usage: $0 library | --are-there | [data] [format] [rendering] [releases] [python] [docs] [mpi] [clang] [plots]" >&2; exit 2 ;;
  esac
done

missing=()
for package in "${packages[@]}"; do
  [ "$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0
[ "$only" != --are-there ] || exit 1

as_root=(env DEBIAN_FRONTEND=noninteractive)
[ "$(id -u)" = 0 ] || as_root=(sudo "${as_root[@]}")
"${as_root[@]}" apt-get update
"${as_root[@]}" apt-get install --yes --no-install-recommends "${missing[@]}"
