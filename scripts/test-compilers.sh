#!/bin/bash
# What only other compilers and linkers see of all that GALE is: libraries, the command, all bindings, examples. Nothing is
# optimized here.
#   usage: scripts/test-compilers.sh [clang] [types] [alone]
#     clang: clang has no warning; shared libraries with hidden symbols serve those who link what is installed, each header
#       of which compiles alone.
#     types: no name stands for two types or has two meanings in libraries that may meet in a program.
#     alone: as types, and each source compiles alone; not without being asked for, as it takes three times as long.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/dependencies.sh mpi python clang
export CMAKE_GENERATOR=Ninja OMP_WAIT_POLICY=passive
environment=$PWD/build-clang/environment python=$PWD/build-clang/environment/bin/python
[ -x "$python" ] || python3 -m venv "$environment"
"$python" -m pip install --quiet nanobind numpy
packages=lib/$("$python" -c 'import sysconfig; print("python" + sysconfig.get_python_version())')/site-packages
everything=(-DCMAKE_BUILD_TYPE=Debug -DGALE_ENABLE_CHEAP_BUILD=ON -DGALE_ENABLE_TESTS=OFF -DGALE_ENABLE_VTK_FILTERS=ON
  -DGALE_ENABLE_MPI=ON -DGALE_ENABLE_TTK=ON -DGALE_ENABLE_PYTHON=ON -DGALE_PYTHON_DIR="$packages"
  -DPython_EXECUTABLE="$python" -Dnanobind_DIR="$("$python" -m nanobind --cmake_dir)")

clang() {
  local build=$PWD/build-clang prefix=$PWD/build-clang/prefix
  local compiler=(-DCMAKE_CXX_COMPILER=clang++-14 -DCMAKE_CXX_FLAGS="-Wall -Wextra -Werror" -DCMAKE_CXX_FLAGS_DEBUG=-O0)
  cmake -S . -B "$build" "${everything[@]}" "${compiler[@]}" -DCMAKE_INSTALL_PREFIX="$prefix" -DBUILD_SHARED_LIBS=ON
  cmake --build "$build" --parallel "$(nproc)"
  rm -rf "$prefix"
  cmake --install "$build" >"$build/installed"

  # What is installed works, and is found by other projects.
  "$prefix/bin/gale" critical-points grid:4 >"$build/said"
  PYTHONPATH=$prefix/$packages "$python" -c 'import gale; print(gale.__version__)'
  PYTHONPATH=$prefix/$packages "$python" -m gale --version
  local project
  for project in consumer filters every_template headers; do
    [ -d unit_tests/install/$project ] || continue
    cmake -S unit_tests/install/$project -B "$build/against/$project" "${compiler[@]}" -DCMAKE_PREFIX_PATH="$prefix" -DCOMPONENTS=io\ outputs
    cmake --build "$build/against/$project" --parallel "$(nproc)"
    [ $project = headers ] || ctest --test-dir "$build/against/$project" --output-on-failure --no-tests=error
  done

  local check=(python3 -B unit_tests/install/check_library_paths.py readelf)
  "${check[@]}" --in "$build/bin" "$build/lib" "$build/bindings" "$build/against"
  "${check[@]}" --in "$prefix" --never "$PWD/src" "$build/lib" "$build/bin" "$build/src" "$build/bindings"
}

# Objects for link-time optimization have all types in them; putting these together compares them, and makes no code. What
# VTK generates for Python is left out, as it waits for linked filters.
types() { # CMAKE_OPTION...
  local build=$PWD/build-types objects
  cmake -S . -B "$build" "${everything[@]}" -DCMAKE_CXX_COMPILER=g++ -DCMAKE_CXX_FLAGS_DEBUG="-O0 -flto" -UCMAKE_UNITY_BUILD "$@"
  objects=$(ninja -C "$build" -t targets all | sed -nE '/(nanobind-static|Python)\.dir/d; s/^((src|bindings)\/.*\.o): CXX_COMPILER.*/\1/p')
  # shellcheck disable=SC2086 # a list
  ninja -C "$build" $objects
  # shellcheck disable=SC2086
  (cd "$build" && g++ -flto -r -flinker-output=rel -nostdlib -Wodr -Werror=odr -Werror=lto-type-mismatch -Wl,-z,muldefs -o types.o $objects)
}

# Without joining sources, as other builds that are cheap do.
alone() { types -DCMAKE_UNITY_BUILD=OFF; }

[ $# -gt 0 ] || set -- clang types
for which in "$@"; do
  case "$which" in
    clang | types | alone) "$which" ;;
    *) echo "usage: $0 [clang] [types] [alone]" >&2; exit 2 ;;
  esac
done
