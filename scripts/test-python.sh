#!/bin/bash
# Builds a wheel of the Python module, installs it in an environment of its own, and runs the module's tests there, first
# with numpy alone, then with all that it works with.
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
"$environment/bin/pip" wheel --quiet --no-deps --wheel-dir "$environment" -C build-dir=build-python \
  -C cmake.define.CMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG" .
"$environment/bin/pip" install --quiet numpy "$environment"/*.whl
tests=$PWD/bindings/python/tests
python3 -B unit_tests/install/check_library_paths.py readelf --in "$environment"/lib/python*/site-packages/gale --never "$PWD"
cd "$environment"
bin/python -B -m unittest discover -s "$tests"
wait $more
everything/bin/pip install --quiet --no-deps ./*.whl
everything/bin/python -B -m unittest discover -s "$tests"
