#!/bin/bash
# Builds a wheel of the Python module, installs it in an environment of its own, and runs the module's tests there, first
# with numpy alone, then with all that it works with. Where scripts/test.sh has built GALE, that is most of the wheel.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/dependencies.sh python
environment=$(mktemp -d)
trap 'rm -rf "$environment"' EXIT
export CMAKE_GENERATOR=${CMAKE_GENERATOR:-Ninja} CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
export OMP_WAIT_POLICY=passive # the tests' threads would keep each other from the cores
python3 -m venv "$environment"
python3 -m venv "$environment/everything"
"$environment/everything/bin/pip" install --quiet numpy gmsh ipykernel matplotlib meshio mypy nbclient pandas pyvista scipy tqdm & # while the module compiles
more=$!
options=(-C build-dir=build-python -C cmake.define.CMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG")
if grep -qs '^GALE_ENABLE_TESTS:.*=ON' build/CMakeCache.txt && grep -qs '^CMAKE_CXX_FLAGS_RELEASE:.*=-O1 -DNDEBUG$' build/CMakeCache.txt; then
  options=(-C build-dir=build -C cmake.define.GALE_ENABLE_TESTS=ON -C cmake.define.GALE_ENABLE_VTK_FILTERS=OFF)
  build=$PWD/build
  cp build/CMakeCache.txt "$environment"
  after() { # makes the folder again what it was
    cd "$build"
    mv "$environment/CMakeCache.txt" .
    rm -rf "$environment" .skbuild-info.json
    cmake . >configured
  }
  trap after EXIT
  rm -f build/.skbuild-info.json # of an environment that is gone: what is configured would be dropped
fi
"$environment/bin/pip" wheel --quiet --no-deps --wheel-dir "$environment" "${options[@]}" .
"$environment/bin/pip" install --quiet numpy "$environment"/*.whl
tests=$PWD/bindings/python/tests
python3 -B unit_tests/install/check_library_paths.py readelf --in "$environment"/lib/python*/site-packages/gale --never "$PWD"
cd "$environment"
bin/python -B -m unittest discover -s "$tests"
wait $more
everything/bin/pip install --quiet --no-deps ./*.whl
everything/bin/python -B -m unittest discover -s "$tests"
