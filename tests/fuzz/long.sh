#!/bin/sh
# An hour a target, or as many seconds as given: sh tests/fuzz/long.sh [seconds = 3600]. New inputs gather in
# build-fuzz/found and are used again the next time.
exec sh "$(dirname "$0")/run.sh" "${1:-3600}"
