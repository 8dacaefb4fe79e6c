#!/bin/bash
# Builds and tests GALE in throw-away roots of Debian sid, with the Kokkos that it packages: twice, since there are two.
# Needs root and debootstrap; says which release it skips and why. What it can set up must pass. Without --all, what
# depends little on Kokkos is left out: files, outputs, the command, examples, fuzzers, faults and installations; of each program's tests a third is run; and of the release in the middle only what computes relations, as
# the oldest, which Debian 12 has, and the newest are tested in all.
#   usage: scripts/test-releases.sh [--with-vtk] [--all]
set -euo pipefail
source_dir=$(cd "$(dirname "$0")/.." && pwd)
. "$source_dir/scripts/throw_away_root.sh"
export DEBIAN_FRONTEND=noninteractive LC_ALL=C

packages=(cmake g++ ninja-build python3 libcli11-dev nlohmann-json3-dev libgtest-dev)
vtk=OFF
all=
for option in "$@"; do
  case "$option" in
    --with-vtk) vtk=ON; packages+=(libvtk9-dev libdeflate-dev) ;;
    --all) all=1 ;;
    *) echo "usage: $0 [--with-vtk] [--all]" >&2; exit 2 ;;
  esac
done

work=$(mktemp -d "${TMPDIR:-/tmp}/gale-releases.XXXXXX")
unset TMPDIR # of this machine, not of the roots
base=$work/base
root=$work/root

trap 'remove_root "$root"; remove_root "$base"; rm -rf "$work"' EXIT

# Sid, with what both tests need: made once, and copied.
set_up() { # PACKAGE...
  { [ -e "$work/made" ] || { make_root "$base" sid "${packages[@]}" && umount "$base/proc" && touch "$work/made"; }; } &&
    cp --archive --reflink=auto "$base" "$root" &&
    mount -t proc proc "$root/proc" &&
    install_in "$root" "$@"
}

# Builds and tests in the root: all, or a part of the tests of these folders.
build_and_test() { # FOLDERS CMAKE_OPTION...
  local folders targets=() tests=() part=()
  read -ra folders <<<"$1"
  shift
  if [ -z "$all" ]; then
    targets=("${folders[@]/#/gale_}")
    targets=(--target "${targets[@]/%/_tests}")
    tests=(--tests-regex "^($(IFS='|'; echo "${folders[*]}"))\$")
    part=(GTEST_TOTAL_SHARDS=3 GTEST_SHARD_INDEX=1)
  fi
  copy_sources "$source_dir" "$root" &&
    chroot "$root" cmake -S /gale -B /build -G Ninja -DCMAKE_BUILD_TYPE=Release -DGALE_ENABLE_VTK=$vtk \
      -DCMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG" -DGALE_ENABLE_CHEAP_BUILD=ON "$@" &&
    chroot "$root" cmake --build /build --parallel "$(nproc)" "${targets[@]}" &&
    chroot "$root" env "${part[@]}" ctest --test-dir /build --output-on-failure --no-tests=error --parallel 2 "${tests[@]}"
}

skip() { echo "SKIPPED $1: $2"; }

test_release() { # NAME PACKAGES FOLDERS CMAKE_OPTIONS [COMMAND_IN_ROOT]
  local name=$1
  echo "=== $name"
  [ -z "$unable" ] || { skip "$name" "$unable"; return; }
  # shellcheck disable=SC2086 # a list
  if ! set_up $2 >"$work/log" 2>&1; then
    skip "$name" "cannot be set up: $(tail -n 1 "$work/log")"
    remove_root "$root"
    [ -e "$work/made" ] || remove_root "$base"
    return
  fi
  [ -z "${5:-}" ] || chroot "$root" sh -c "$5"
  # shellcheck disable=SC2086 # a list
  build_and_test "$3" $4 || failed+=("$name")
  remove_root "$root"
}

failed=()
unable=$(why_no_root)

# That package's CMake files name two archives that it doesn't hold; they are empty anyway.
# shellcheck disable=SC2016
test_release "sid with libkokkos-dev (Kokkos 5, OpenMP alone, C++20)" libkokkos-dev \
  "base mesh relations runtime algorithms" -DGALE_ENABLE_KOKKOS_KERNELS=OFF '
  for name in kokkosalgorithms kokkossimd; do
    archive=/usr/lib/$(gcc -dumpmachine)/lib$name.a
    [ -e "$archive" ] || ar cr "$archive"
  done'

# Kokkos-Kernels links LAPACK and BLAS, which its package doesn't pull in.
test_release "sid with libtrilinos-kokkos-dev (Kokkos and Kokkos-Kernels 4.5, Serial alone)" \
  "libtrilinos-kokkos-dev libtrilinos-kokkos-kernels-dev liblapack-dev libblas-dev" "base relations runtime" ""

[ ${#failed[@]} = 0 ] || { printf 'FAILED %s\n' "${failed[@]}" >&2; exit 1; }
