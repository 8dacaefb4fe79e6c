#!/bin/bash
# Finds the critical points of a brain and the Morse-Smale complex of another, and draws them: build/demo/brain.vtp,
# brain.png and complex.png. Enough alone on a bare Debian 12.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/dependencies.sh data rendering
export CMAKE_GENERATOR=${CMAKE_GENERATOR:-Ninja} # of a new build folder; one that is there keeps its own
cmake --preset ci
cmake --build --preset ci --target gale_app --parallel "$(nproc)"
cmake -S examples/render_critical_points -B build/render_critical_points
cmake --build build/render_critical_points

volume=/usr/share/mricron/templates/ch2bet.nii.gz
mkdir -p build/demo
build/bin/gale critical-points "$volume" --above 0 -o build/demo/brain.vtp --report build/demo/brain.json
xvfb-run --auto-servernum build/render_critical_points/render_critical_points "$volume" build/demo/brain.vtp build/demo/brain.png
xvfb-run --auto-servernum build/bin/gale morse-smale "$(dirname "$volume")/inia19-t1-brain.nii.gz" --above 0 --persistence 10% --render build/demo/complex.png
echo "wrote build/demo/brain.vtp, brain.json, brain.png and complex.png"
