#!/bin/bash
# Fuzzes for long what the tests fuzz for seconds: reading in this process and through the command, random meshes.
#   usage: scripts/fuzz.sh [--build FOLDER] [COUNT] [FROM]
#     COUNT mutated files from number FROM on (100000 from 0); finds go to finds/, each with how it came about.
#     For the sanitizers: cmake --preset sanitize -DGALE_ENABLE_EXAMPLES=OFF, and --build build-sanitize.
set -euo pipefail
cd "$(dirname "$0")/.."

build=build
if [ "${1:-}" = --build ]; then
  build=$2
  shift 2
fi
count=${1:-100000} from=${2:-0}
export ASAN_OPTIONS=${ASAN_OPTIONS:-allocator_may_return_null=1:detect_leaks=0} OMP_WAIT_POLICY=passive

cmake --build "$build" --target gale_fuzz_read gale_fuzz_meshes gale_app
corpus=$build/unit_tests/fuzz/corpus
python3 -B unit_tests/fuzz/make_corpus.py "$corpus"
failed=0
"$build/bin/gale_fuzz_read" "$corpus" --count "$count" --from "$from" --finds finds || failed=1
"$build/bin/gale_fuzz_meshes" --count $((count / 100)) --from "$from" || failed=1
GALE=$build/bin/gale python3 -B unit_tests/fuzz/fuzz_command.py "$corpus" --count $((count / 100)) --from "$from" --finds finds || failed=1
exit $failed
