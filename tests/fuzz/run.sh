#!/bin/sh
# Builds the fuzz targets with clang, libFuzzer and the address and undefined-behaviour sanitizers, and runs each
# one for so many seconds: sh tests/fuzz/run.sh [seconds = 20] [folder for new inputs]. Inputs that break a rule stay
# in that folder. Put them into tests/fuzz/corpus when the defect is mended. Only the library, for d = 2
# and 3, and the targets are built.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
seconds=${1:-20}
found=${2:-$root/build-fuzz/found}
cd "$root"
cmake -S . -B build-fuzz -G Ninja -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=None \
  -DCMAKE_C_FLAGS="-O1 -fsanitize=fuzzer-no-link" -DCMAKE_CXX_FLAGS="-O1 -fsanitize=fuzzer-no-link" -DJAM_FUZZ=ON \
  -DJAM_SANITIZE=address,undefined -DJAM_DIMENSIONS="2;3" -DJAM_WERROR=ON \
  -DJAM_BUILD_EXAMPLES=OFF -DJAM_BUILD_CLI=OFF >/dev/null
cmake --build build-fuzz --target fuzz_read fuzz_checkpoint fuzz_calls
status=0
if [ -w /dev/shm ]; then export TMPDIR=/dev/shm; fi  # files that targets write
export UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
for target in read checkpoint calls; do
  echo "== $target"
  mkdir -p "$found/$target"
  build-fuzz/tests/fuzz/fuzz_$target -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -print_final_stats=1 \
    -artifact_prefix="$found/$target-" "$found/$target" "tests/fuzz/corpus/$target" >"$found/$target.log" 2>&1 ||
    status=1
  grep -aE "SUMMARY|runtime error|broken:|stat::number_of_executed_units|DONE" "$found/$target.log" || true
done
exit $status
