#!/bin/bash
# Builds and tests GALE in throw-away roots of Debian sid, with the Kokkos that it packages: twice, since there are two.
# Needs root and debootstrap; says which release it skips and why. What it can set up must pass. Without --all, what
# depends little on Kokkos is left out: headers by themselves, examples, fuzzers, faults, installations, and most of the
# command.
#   usage: scripts/test-releases.sh [--with-vtk] [--all]
set -euo pipefail
source_dir=$(cd "$(dirname "$0")/.." && pwd)
export DEBIAN_FRONTEND=noninteractive LC_ALL=C

packages=(cmake g++ ninja-build python3 libcli11-dev nlohmann-json3-dev libgtest-dev)
vtk=OFF
folders=(base mesh relations runtime algorithms io outputs uninitialized)
programs=("${folders[@]/#/gale_}")
targets=(--target gale_app "${programs[@]/%/_tests}")
tests=(--tests-regex "^($(IFS='|'; echo "${folders[*]}")|app\.(meshes|morse_smale_geometry|outputs|usage))\$")
for option in "$@"; do
  case "$option" in
    --with-vtk) vtk=ON; packages+=(libvtk9-dev) ;;
    --all) targets=() tests=() ;;
    *) echo "usage: $0 [--with-vtk] [--all]" >&2; exit 2 ;;
  esac
done

work=$(mktemp -d "${TMPDIR:-/tmp}/gale-releases.XXXXXX")
unset TMPDIR # of this machine, not of the roots
base=$work/base
root=$work/root

remove() { # ROOT
  ! mountpoint --quiet "$1/proc" || umount "$1/proc"
  rm -rf --one-file-system "$1"
}
trap 'remove "$root"; remove "$base"; rm -rf "$work"' EXIT

# The archive that apt itself is set up with.
mirror() {
  # shellcheck disable=SC2016 # apt's variables
  apt-get indextargets --format '$(LABEL) $(REPO_URI)' 'Created-By: Packages' |
    awk '$1 == "Debian" || $NF ~ /\/debian\/?$/ { print $NF; exit }'
}

# Sid, with what both tests need: made once, and copied.
make_base() {
  # An archive that stands still, or a clock that is ahead, outlives the week that sid's index is valid.
  debootstrap --variant=minbase sid "$base" "$mirror" &&
    mount -t proc proc "$base/proc" &&
    chroot "$base" apt-get -o Acquire::Check-Valid-Until=false update &&
    chroot "$base" apt-get install --yes --no-install-recommends "${packages[@]}" &&
    umount "$base/proc"
}

set_up() { # PACKAGE...
  { [ -e "$work/made" ] || { make_base && touch "$work/made"; }; } &&
    cp --archive --reflink=auto "$base" "$root" &&
    mount -t proc proc "$root/proc" &&
    chroot "$root" apt-get install --yes --no-install-recommends "$@"
}

build_and_test() { # CMAKE_OPTION...
  mkdir "$root/gale" &&
    tar -C "$source_dir" --exclude=./.git --exclude='./build*' -cf - . | tar -C "$root/gale" -xf - &&
    chroot "$root" cmake -S /gale -B /build -G Ninja -DCMAKE_BUILD_TYPE=Release -DGALE_ENABLE_VTK=$vtk \
      -DCMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG" -DGALE_ENABLE_CHEAP_BUILD=ON "$@" &&
    chroot "$root" cmake --build /build --parallel "$(nproc)" "${targets[@]}" &&
    chroot "$root" ctest --test-dir /build --output-on-failure --no-tests=error --parallel 2 "${tests[@]}"
}

skip() { echo "SKIPPED $1: $2"; }

test_release() { # NAME PACKAGES CMAKE_OPTIONS [COMMAND_IN_ROOT]
  local name=$1
  echo "=== $name"
  [ -z "$unable" ] || { skip "$name" "$unable"; return; }
  # shellcheck disable=SC2086 # a list
  if ! set_up $2 >"$work/log" 2>&1; then
    skip "$name" "cannot be set up: $(tail -n 1 "$work/log")"
    remove "$root"
    [ -e "$work/made" ] || remove "$base"
    return
  fi
  [ -z "${4:-}" ] || chroot "$root" sh -c "$4"
  # shellcheck disable=SC2086 # a list
  build_and_test $3 || failed+=("$name")
  remove "$root"
}

mirror=$(mirror)
eval "$(apt-config shell http_proxy Acquire::http::Proxy)" # debootstrap doesn't ask apt
[ -z "${http_proxy:-}" ] || export http_proxy
failed=()
unable=
if [ "$(id -u)" != 0 ]; then
  unable="only root can make a root"
elif ! command -v debootstrap >/dev/null; then
  unable="there is no debootstrap"
elif [ -z "$mirror" ]; then
  unable="apt knows no Debian archive"
fi

# That package's CMake files name two archives that it doesn't hold; they are empty anyway.
# shellcheck disable=SC2016
test_release "sid with libkokkos-dev (Kokkos 5, OpenMP alone, C++20)" libkokkos-dev -DGALE_ENABLE_KOKKOS_KERNELS=OFF '
  for name in kokkosalgorithms kokkossimd; do
    archive=/usr/lib/$(gcc -dumpmachine)/lib$name.a
    [ -e "$archive" ] || ar cr "$archive"
  done'

# Kokkos-Kernels links LAPACK and BLAS, which its package doesn't pull in.
test_release "sid with libtrilinos-kokkos-dev (Kokkos and Kokkos-Kernels 4.5, Serial alone)" \
  "libtrilinos-kokkos-dev libtrilinos-kokkos-kernels-dev liblapack-dev libblas-dev" ""

[ ${#failed[@]} = 0 ] || { printf 'FAILED %s\n' "${failed[@]}" >&2; exit 1; }
