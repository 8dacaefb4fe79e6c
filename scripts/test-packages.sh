#!/bin/bash
# Builds packages of what is committed and tries them as strangers have them, in throw-away roots: Debian's (the packages,
# lintian, their tests) and PyPI's (the wheel). Needs root and debootstrap. Not a part of .ci/run: each compiles all.
#   usage: scripts/test-packages.sh [--results FOLDER] [debian] [wheel]
#     FOLDER: where packages are left, build/packages by default. With CCACHE_DIR the compiler's results are kept there.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/throw_away_root.sh
export DEBIAN_FRONTEND=noninteractive LC_ALL=C

results=$PWD/build/packages kinds=()
while [ $# -gt 0 ]; do
  case "$1" in
    --results) results=$(realpath -m "$2"); shift ;;
    debian | wheel) kinds+=("$1") ;;
    *) echo "usage: $0 [--results FOLDER] [debian] [wheel]" >&2; exit 2 ;;
  esac
  shift
done
[ ${#kinds[@]} -gt 0 ] || kinds=(debian wheel)
unable=$(why_no_root)
[ -z "$unable" ] || { echo "SKIPPED: $unable"; exit 0; }

scripts/release.sh
version=$(sed -n 's/^project(gale VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
tarball=$PWD/build/gale-$version.tar.gz
work=$(mktemp -d "${TMPDIR:-/tmp}/gale-packages.XXXXXX")
unset TMPDIR # of this machine, not of the roots
builder=$work/builder user=$work/user
mkdir -p "$results"
remove_all() {
  ! mountpoint --quiet "$builder/ccache" || umount "$builder/ccache"
  remove_root "$builder"
  remove_root "$user"
}
trap 'remove_all; rm -rf "$work"' EXIT

# A root to build in, of a release, with these packages.
make_builder() { # RELEASE PACKAGE...
  make_root "$builder" "$@" ccache >"$work/log" 2>&1 || { tail -n 20 "$work/log" >&2; return 1; }
  mkdir -p "$builder/ccache" "$builder/build"
  [ -z "${CCACHE_DIR:-}" ] || mount --bind "$CCACHE_DIR" "$builder/ccache"
}

in_builder() { # FOLDER COMMAND...
  local folder=$1
  shift
  chroot "$builder" env CCACHE_DIR=/ccache CCACHE_SLOPPINESS=pch_defines,time_macros PATH="/usr/lib/ccache:$PATH" \
    sh -c 'cd "$0" && exec "$@"' "$folder" "$@"
}

said_seconds() { # WHAT SINCE
  echo "=== $1: $((SECONDS - $2)) s"
}

# Debian 12, to which nanobind comes from the next release: headers and a script, for any architecture.
debian() {
  local began=$SECONDS
  make_builder bookworm build-essential ca-certificates fakeroot lintian
  echo "deb $(archive) trixie main" >"$builder/etc/apt/sources.list.d/trixie.list"
  printf 'Package: *\nPin: release n=trixie\nPin-Priority: 50\n\nPackage: nanobind-dev python3-nanobind robin-map-dev\nPin: release n=trixie\nPin-Priority: 600\n' \
    >"$builder/etc/apt/preferences.d/trixie"
  cp "$tarball" "$builder/build/gale_$version.orig.tar.gz"
  tar -C "$builder/build" -xf "$tarball"
  chroot "$builder" apt-get -o Acquire::Check-Valid-Until=false --quiet update
  chroot "$builder" apt-get -o Dpkg::Options::=--force-unsafe-io --quiet --yes --no-install-recommends build-dep "/build/gale-$version" >"$work/log" 2>&1 ||
    { tail -n 20 "$work/log" >&2; return 1; }
  said_seconds "the root for Debian's packages" "$began"
  began=$SECONDS
  in_builder "/build/gale-$version" dpkg-buildpackage --no-sign
  said_seconds "dpkg-buildpackage" "$began"
  # Nobody has filed the intention to package it with Debian, and nobody maintains it there.
  in_builder /build lintian --fail-on error --suppress-tags initial-upload-closes-no-bugs "gale_$version-1_$(dpkg --print-architecture).changes"
  cp "$builder"/build/*.{deb,dsc,changes,buildinfo,debian.tar.xz} "$builder"/build/*.orig.tar.gz "$results/"
  remove_all

  make_root "$user" bookworm autopkgtest >"$work/log" 2>&1
  mkdir "$user/packages"
  cp "$results"/*.{deb,dsc,debian.tar.xz} "$results"/*.orig.tar.gz "$user/packages/"
  began=$SECONDS
  chroot "$user" sh -c 'apt-get -o Dpkg::Options::=--force-unsafe-io --quiet --yes install /packages/gale_*.deb /packages/libgale0*.deb xvfb xauth libgl1-mesa-dri >/dev/null &&
    xvfb-run --auto-servernum gale morse-smale grid:32 --persistence 10% --render /packages/picture.png'
  cp "$user/packages/picture.png" "$results/"
  said_seconds "from apt install to a picture" "$began"
  chroot "$user" sh -c 'cd /packages && autopkgtest --no-built-binaries ./*.deb ./*.dsc -- null'
  remove_all
}

for kind in "${kinds[@]}"; do
  echo "=== $kind"
  "$kind"
done
