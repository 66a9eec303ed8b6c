#!/bin/sh
# Builds the fuzz targets with clang, libFuzzer and the address and undefined-behaviour sanitizers, and runs all at
# once for so many seconds: sh tests/fuzz/run.sh [seconds = 20] [folder for new inputs] [seed = 1]. The same seed draws
# the same inputs again, so that a change is judged by what it did itself; 0 draws new ones. Inputs
# that break a rule stay in that folder. Put them into tests/fuzz/corpus when the defect is mended.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
seconds=${1:-20}
found=${2:-$root/build-asan/found}
seed=${3:-1}
cd "$root"
. tests/sanitized.sh
sanitize_by_clang
cmake --build build-asan --target fuzz_read fuzz_checkpoint fuzz_calls
if [ -w /dev/shm ]; then export TMPDIR=/dev/shm; fi  # files that targets write
targets='read checkpoint calls'
for target in $targets; do
  mkdir -p "$found/$target"
  rm -f "$found/$target.passed"
  { build-asan/tests/fuzz/fuzz_$target -seed="$seed" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 \
      -print_final_stats=1 -artifact_prefix="$found/$target-" "$found/$target" "tests/fuzz/corpus/$target" \
      >"$found/$target.log" 2>&1 && : >"$found/$target.passed"; } &
done
wait
status=0
for target in $targets; do
  echo "== $target"
  grep -aE "SUMMARY|runtime error|broken:|stat::number_of_executed_units|DONE" "$found/$target.log" || true
  [ -e "$found/$target.passed" ] || status=1
done
exit $status
