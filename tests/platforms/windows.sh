#!/bin/sh
# Windows by mingw-w64, run by wine: the library, jam-pack, the examples in C and C++, tests that need no POSIX, bits.
set -eu
cd "$(dirname "$0")/../.."
. tests/platforms/common.sh
triplet=x86_64-w64-mingw32
need_or_skip g++-mingw-w64-x86-64-posix wine64 wine ninja-build cmake pkg-config libeigen3-dev libspectra-dev || exit 0
native_files
folder=build-$triplet
sh tests/platforms/dependencies.sh "$folder-libraries" "$triplet" -DCMAKE_SYSTEM_NAME=Windows \
  -DCMAKE_C_FLAGS=-D__USE_MINGW_ANSI_STDIO=1
export WINEPREFIX="$PWD/$folder/wine" WINEDEBUG=-all
# Z: is the root folder; the library is beside the folder of the tests.
WINEPATH="Z:$(echo "$PWD/$folder" | tr / '\\')"
export WINEPATH
begin_platform "$folder" "Windows on x86_64, mingw-w64 GCC $("$triplet-gcc-posix" -dumpversion | sed "s/-.*//"), wine"
configure "$folder" -DCMAKE_SYSTEM_NAME=Windows -DCMAKE_SYSTEM_PROCESSOR=x86_64 \
  -DCMAKE_C_COMPILER="$triplet-gcc-posix" -DCMAKE_CXX_COMPILER="$triplet-g++-posix" \
  -DCMAKE_RC_COMPILER="$triplet-windres" -DCMAKE_CROSSCOMPILING_EMULATOR="$(command -v wine)" \
  -DSPECTRA_INCLUDE="$PWD/$folder-libraries/include" -DJAM_BUILD_EXAMPLES=ON
status=0
test_platform "$folder" || status=1
ctest --test-dir "$folder" -j "$jobs" -L examples --timeout 300 >"$folder/examples.log" 2>&1 || status=1
grep 'tests passed' "$folder/examples.log"
exit $status
