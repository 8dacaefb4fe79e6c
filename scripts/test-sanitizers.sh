#!/bin/bash
# Runs what manages memory and threads by itself under the sanitizers: address and undefined behaviour, then threads.
# Without VTK, the command and the examples, whose libraries aren't built for that; by clang, unoptimized, which is built in
# a third of the processors' time.
#   usage: scripts/test-sanitizers.sh [address] [thread] [sweeps]
#     sweeps: what algorithms' sweeps write and several threads read, under the thread sanitizer; only if asked for.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/dependencies.sh clang
# Some tests ask for more memory than any machine has: that must fail as it does without a sanitizer. With the callers of
# malloc alone, what the threads' library loses is told from what is lost on its threads (unit_tests/leaks.supp).
export ASAN_OPTIONS=allocator_may_return_null=1:malloc_context_size=3 TSAN_OPTIONS=allocator_may_return_null=1
export CMAKE_GENERATOR=${CMAKE_GENERATOR:-Ninja} OMP_PROC_BIND=false OMP_WAIT_POLICY=passive
lean=(-DGALE_ENABLE_KOKKOS_KERNELS=OFF -DGALE_ENABLE_VTK=OFF -DGALE_ENABLE_APP=OFF -DGALE_ENABLE_EXAMPLES=OFF
  -DGALE_ENABLE_TTK=ON -DCMAKE_CXX_COMPILER=clang++-14 -DCMAKE_CXX_FLAGS_DEBUG="-O0 -g1")

# The thread sanitizer wants addresses where older kernels put them; some containers don't let us ask for that.
fixed_addresses=()
! setarch --addr-no-randomize true 2>/dev/null || fixed_addresses=(setarch --addr-no-randomize)

logs=$(mktemp -d)
trap 'rm -rf "$logs"' EXIT

# build PRESET FOLDER...
build() {
  local preset=$1
  shift
  cmake --preset "$preset" "${lean[@]}"
  cmake --build --preset "$preset" --parallel "$(nproc)" --target "${@/%/_tests}"
}

# run_tests PRESET FOLDER [FILTER]
run_tests() {
  local tests="build-$1/bin/gale_$2_tests" filter=${3:-*}
  echo "=== $1: $2"
  [ -n "$("${fixed_addresses[@]}" "$tests" --gtest_list_tests --gtest_filter="$filter")" ] ||
    { echo "$0: no test of $2 is called $filter" >&2; exit 1; }
  "${fixed_addresses[@]}" "$tests" --gtest_brief=1 --gtest_filter="$filter"
}

# together COMMAND... : at the same time, as one test seldom uses both cores. What they print comes one after the other.
together() {
  local jobs=() failed=0 command k
  for ((k = 1; k <= $#; ++k)); do
    read -ra command <<<"${!k}"
    "${command[@]}" >"$logs/$k" 2>&1 &
    jobs+=($!)
  done
  for job in "${jobs[@]}"; do wait "$job" || failed=1; done
  cat "$logs"/*
  rm "$logs"/*
  [ $failed = 0 ]
}

# part N PRESET FOLDER [FILTER]: one test of N, as they run each mesh by each structure, which is minutes here.
part() {
  local parts=$1
  shift
  GTEST_TOTAL_SHARDS=$parts GTEST_SHARD_INDEX=1 run_tests "$@"
}

# These take longer than all others together to compare a mesh with brute force; others have such vertices and segments too.
large="*Of.*/random_hubs*:*Of.*/random_tetrahedra*:*Of.*/cone_over_sphere_2000*:*/hub_of_600_triangles*"

address() {
  export LSAN_OPTIONS=suppressions=$PWD/unit_tests/leaks.supp:print_suppressions=0
  build sanitize gale_base gale_mesh gale_relations gale_runtime gale_algorithms gale_io gale_ttk
  together "part 20 sanitize algorithms -$large:GradientFromCells.has_the_known_counts_on_a_grid" all_but_algorithms
}

all_but_algorithms() {
  local folder
  for folder in base io; do run_tests sanitize $folder; done
  part 3 sanitize mesh
  part 3 sanitize ttk "-$large:*/cone_over_sphere_2000:*/random_hubs:TtkNumbering.a_sweep_makes_a_block_about_once*"
  for folder in runtime relations; do part 9 sanitize $folder "-$large:MixedConsumers.that_jump_at_random*"; done
}

# Runs, of the runtime, a part of all but what takes minutes here to compare every mesh with brute force, or has one thread.
thread() {
  build sanitize-thread gale_base gale_mesh gale_runtime gale_ttk
  together "run_tests sanitize-thread base" "run_tests sanitize-thread mesh Encoding.*" \
    "run_tests sanitize-thread ttk TtkBlockStore.*:TtkTriangulationOnThreads.*" \
    "part 3 sanitize-thread runtime -MixedSweep.*:Tests/MixedSweepOf.*:Tests/DeviceSweepOf.*:*RelationOf*:DeviceSweep.goes_through_large*:$large"
}

sweeps() {
  build sanitize-thread gale_algorithms
  run_tests sanitize-thread algorithms CriticalPoints.*:DiscreteGradient.*:MorseSmaleComplex.*:Simplify.*:MergeTree*
}

[ $# -gt 0 ] || set -- address thread
for which in "$@"; do
  case "$which" in
    address | thread | sweeps) "$which" ;;
    *) echo "usage: $0 [address] [thread] [sweeps]" >&2; exit 2 ;;
  esac
done
