#!/bin/bash
# Builds the plugin in a throw-away root with Debian's ParaView, and runs its tests there in pvbatch: with that of Debian 12,
# which brings a VTK of its own, or with sid's, on sid's VTK, where the filters' own tests are run as well. Needs root and
# debootstrap; says why where it skips. What it can set up must pass.
#   usage: scripts/test-paraview.sh [--sid] [--keep ROOT]   with --keep: make the root there, or take the one that is there,
#                                                           and leave it
set -euo pipefail
source_dir=$(cd "$(dirname "$0")/.." && pwd)
. "$source_dir/scripts/throw_away_root.sh"
export DEBIAN_FRONTEND=noninteractive LC_ALL=C

keep=
release=bookworm
while [ $# != 0 ]; do
  case "$1" in
    --sid) release=sid ;;
    --keep) keep=${2:?$1 wants a folder} && shift ;;
    *) echo "usage: $0 [--sid] [--keep ROOT]" >&2; exit 2 ;;
  esac
  shift
done

# paraview-dev leaves out what its own CMake files look for: from libdouble-conversion-dev on.
packages=(paraview-dev python3-paraview xvfb xauth libgl1-mesa-dri cmake g++ ninja-build libtrilinos-kokkos-dev libcli11-dev
  nlohmann-json3-dev libgtest-dev python3-dev libdouble-conversion-dev libexpat1-dev libfreetype-dev libgl-dev libglew-dev
  liblz4-dev liblzma-dev libopenmpi-dev zlib1g-dev)
if [ "$release" = sid ]; then
  packages+=(libvtk9-dev qt6-base-dev)
else
  packages+=(qtbase5-dev)
fi

unable=$(why_no_root)
[ -z "$unable" ] || { echo "SKIPPED ParaView: $unable"; exit 0; }
work=$(mktemp -d "${TMPDIR:-/tmp}/gale-paraview.XXXXXX")
unset TMPDIR # of this machine, not of the root
root=${keep:-$work/root}
clean_up() {
  if [ -z "$keep" ]; then
    remove_root "$root"
  elif mountpoint --quiet "$root/proc"; then
    umount "$root/proc"
  fi
  rm -rf "$work"
}
trap clean_up EXIT

if [ -e "$root/usr/bin/pvbatch" ]; then
  mount -t proc proc "$root/proc"
elif ! make_root "$root" "$release" "${packages[@]}" >"$work/log" 2>&1; then
  echo "SKIPPED ParaView: a root cannot be set up: $(tail -n 1 "$work/log")"
  exit 0
fi
rm -rf --one-file-system "$root/gale"
copy_sources "$source_dir" "$root"
if [ "$release" = sid ]; then
  # What its CMake files call the Python modules has no tag, as the modules have.
  # shellcheck disable=SC2016
  chroot "$root" sh -c 'for module in /usr/lib/python3/dist-packages/paraview/*/*.cpython-*.so; do
    ln -sf "$module" "${module%%.cpython-*}.so"
  done'
fi
build_and_test() { # TESTS OPTION TARGET...
  local tests=$1 option=$2
  shift 2
  rm -rf --one-file-system "$root/build"
  chroot "$root" cmake -S /gale -B /build -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG" \
    -DGALE_ENABLE_CHEAP_BUILD=ON -DGALE_ENABLE_KOKKOS_KERNELS=OFF -DGALE_ENABLE_EXAMPLES=OFF "$option"
  chroot "$root" cmake --build /build --parallel "$(nproc)" --target gale_app "$@"
  chroot "$root" ctest --test-dir /build --output-on-failure --no-tests=error --tests-regex "$tests"
}
build_and_test '^paraview$' -DGALE_ENABLE_PARAVIEW=ON GALE
[ "$release" = bookworm ] || build_and_test '^vtk_filters' -DGALE_ENABLE_VTK_FILTERS=ON gale_vtk_filters_tests vtkFiltersGalePython
