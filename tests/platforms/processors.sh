#!/bin/sh
# Other processors: cross builds by Debian's compilers without LAPACK and Clp, unit tests and tests of the C interface
# under qemu, and the bits of dynamics and crunch.
# usage: processors.sh [TRIPLET ...]     aarch64-linux-gnu s390x-linux-gnu riscv64-linux-gnu by default
# A processor whose compiler or emulator cannot be installed is skipped, and the script says so. Results stay in
# build-TRIPLET/result.json; table.py makes the page's table of them.
set -eu
cd "$(dirname "$0")/../.."
. tests/platforms/common.sh
need_or_skip qemu-user ninja-build cmake pkg-config libeigen3-dev libspectra-dev || exit 0
native_files
status=0
for triplet in ${*:-aarch64-linux-gnu s390x-linux-gnu riscv64-linux-gnu}; do
  echo "== $triplet"
  need_or_skip "gcc-$triplet" "g++-$triplet" || continue
  processor=${triplet%%-*}
  folder=build-$triplet
  sh tests/platforms/dependencies.sh "$folder-libraries" "$triplet" -DCMAKE_SYSTEM_NAME=Linux
  begin_platform "$folder" "Linux on $processor, $("$triplet-gcc" -dumpversion | sed 's/^/GCC /'), emulated"
  configure "$folder" -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR="$processor" \
    -DCMAKE_C_COMPILER="$triplet-gcc" -DCMAKE_CXX_COMPILER="$triplet-g++" \
    -DCMAKE_CROSSCOMPILING_EMULATOR="qemu-$processor;-L;/usr/$triplet" \
    -DSPECTRA_INCLUDE="$PWD/$folder-libraries/include"
  test_platform "$folder" || status=1
done
exit $status
