#!/bin/sh
# Fuzzes every target: sh tests/fuzz/run.sh [MINUTES a target; 1 in all unless given] [TARGET...]
# What is found lies in build/fuzz/TARGET-*; what reaches new code is kept in build/fuzz/corpus for the next time.
set -eu
cd "$(dirname "$0")/../.."
minutes=${1:-}
if [ $# -gt 0 ]; then shift; fi
all="pack_json manifest scene preset obj_mesh color_list cache_entry" # command_line is run where it is named
targets=${*:-$all}
cmake -G Ninja -S tests/fuzz -B build/fuzz -D CMAKE_CXX_COMPILER="${CLANGXX:-clang++-14}" >/dev/null
# Quiet unless it fails: what the compiler says is on stdout.
if ! ninja -C build/fuzz ${FUZZ_BUILD_JOBS:+-j "$FUZZ_BUILD_JOBS"} $(printf 'fuzz_%s ' $targets) >build/fuzz/build.log; then
  tail -n 40 build/fuzz/build.log
  exit 1
fi
# A look in passing tries the same inputs each time; a hunt tries others.
if [ -n "$minutes" ]; then seconds=$((minutes * 60)) seed=0; else seconds=9 seed=1; fi
made=$PWD/build/fuzz # in full: a target may go to another folder
for target in $targets; do
  mkdir -p "$made/corpus/$target"
  log=$made/$target.log
  if ! "$made/fuzz_$target" -seed=$seed -max_total_time="$seconds" ${FUZZ_RUNS:+-runs="$FUZZ_RUNS"} -timeout=60 -rss_limit_mb=2048 -print_final_stats=1 \
    -artifact_prefix="$made/$target-" "$made/corpus/$target" "$PWD/tests/fuzz/seeds/$target" >"$log" 2>&1; then
    tail -n 40 "$log"
    echo "fuzz: $target failed; the input is build/fuzz/$target-*"
    exit 1
  fi
  echo "fuzz: $target: $(sed -n 's/.*number_of_executed_units: *//p' "$log") inputs, nothing found"
done
