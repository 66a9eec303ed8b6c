#!/bin/sh
# An hour a target, or as many seconds as given: sh tests/fuzz/long.sh [seconds = 3600]. New inputs gather in
# build-asan/found and are used again the next time. Then the soak test and odd objects for Python as long, with
# the release build of tests/run.sh.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
seconds=${1:-3600}
status=0
sh "$root/tests/fuzz/run.sh" "$seconds" "$root/build-asan/found" 0 || status=1
if [ -x "$root/build/tests/fuzz/soak" ]; then
  "$root/build/tests/fuzz/soak" "$seconds" "$(date +%s)" || status=1
  PYTHONPATH=$root/build/python /usr/bin/python3 -B "$root/tests/fuzz/converters.py" "$seconds" "$(date +%s)" ||
    status=1
  # 8000 of each kind, whatever the time
  PYTHONPATH=$root/build/python OPENBLAS_NUM_THREADS=1 /usr/bin/python3 -B "$root/tests/fuzz/packings.py" 8000 ||
    status=1
else
  echo "no build/tests/fuzz/soak: make the release build first (sh tests/run.sh release)" >&2
  status=1
fi
exit $status
