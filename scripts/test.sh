#!/bin/bash
# Builds GALE in build/ and runs all tests: enough alone on a bare Debian 12.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/dependencies.sh data
cmake --preset default
cmake --build --preset default --parallel "$(nproc)"
ctest --preset default --parallel 2
