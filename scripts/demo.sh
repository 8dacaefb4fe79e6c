#!/bin/bash
# Finds the critical points of a brain and the Morse-Smale complex of another, and draws them: build-demo/brain.vtp,
# brain.png, complex_critical_points.vtp, complex_separatrices1.vtp and complex.png. Enough alone on a bare Debian 12.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/dependencies.sh command
export CMAKE_GENERATOR=${CMAKE_GENERATOR:-Ninja} # of a new build folder; one that is there keeps its own
cmake --preset demo
nice cmake --build --preset demo --target gale_app --parallel "$(nproc)" &
build=$!
scripts/dependencies.sh command data drawing || { wait $build || :; exit 1; } # while it compiles
wait $build

cd build-demo
volumes=/usr/share/mricron/templates
draw() { xvfb-run --auto-servernum /usr/bin/python3 ../examples/draw_volume.py "$@"; }
bin/gale critical-points $volumes/ch2bet.nii.gz --above 0 -o brain.vtp --report brain.json
bin/gale morse-smale $volumes/inia19-t1-brain.nii.gz --above 0 --persistence 10% -o complex --no-{de,a}scending-segmentation
draw $volumes/ch2bet.nii.gz brain.png brain.vtp &
draw $volumes/inia19-t1-brain.nii.gz complex.png complex_critical_points.vtp complex_separatrices1.vtp
wait $!
echo "wrote brain.vtp, brain.json, brain.png, complex_critical_points.vtp, complex_separatrices1.vtp and complex.png in build-demo"
