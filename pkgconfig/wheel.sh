#!/bin/sh
# wheel.sh FOLDER [PYTHON...]: a wheel for each Python (/usr/bin/python3 by default), made on Debian by its compiler.
# Each has one build folder, ./build-wheel-PYTHON, so that the next wheel is made faster. The wheel is for systems as
# new as this one; release.sh makes one for older systems.
set -eu
cd "$(dirname "$0")/.."
. tests/debian.sh
need_packages build-essential cmake ninja-build pkg-config swig python3-dev zlib1g-dev libeigen3-dev libspectra-dev
mkdir -p "$1"
folder=$1
shift
for python in "${@:-/usr/bin/python3}"; do
  version=$("$python" -c 'import sys; print("%d%d" % sys.version_info[:2])')
  echo "wheel for $python: takes minutes, messages are in $folder/log" >&2
  PYTHONPATH=bindings/python "$python" -B -c \
    'import build_wheel, sys; print(build_wheel.build_wheel(sys.argv[1], {"build-dir": sys.argv[2]}))' \
    "$folder" "$PWD/build-wheel-$version" >"$folder/log" || { tail -20 "$folder/log"; exit 1; }
  tail -1 "$folder/log"
done
rm -f "$folder/log"
