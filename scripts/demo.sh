#!/bin/bash
# Finds the critical points of a brain and the Morse-Smale complex of another, and draws them: build-demo/brain.vtp,
# brain.png and complex.png. Enough alone on a bare Debian 12.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/configure.sh demo build-demo "data rendering"
cmake --build --preset demo --target gale_app --parallel "$(nproc)"
cmake -S examples/render_critical_points -B build-demo/render_critical_points
cmake --build build-demo/render_critical_points

cd build-demo
volumes=/usr/share/mricron/templates
bin/gale critical-points $volumes/ch2bet.nii.gz --above 0 -o brain.vtp --report brain.json
xvfb-run --auto-servernum render_critical_points/render_critical_points $volumes/ch2bet.nii.gz brain.vtp brain.png
xvfb-run --auto-servernum bin/gale morse-smale $volumes/inia19-t1-brain.nii.gz --above 0 --persistence 10% --render complex.png
echo "wrote build-demo/brain.vtp, brain.json, brain.png and complex.png"
