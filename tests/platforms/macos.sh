#!/bin/sh
# macOS by zig's Clang: the library, jam-pack and the examples in C and C++ as Mach-O, for both processors. Nothing
# is run.
set -eu
cd "$(dirname "$0")/../.."
. tests/platforms/common.sh
need_or_skip ninja-build cmake pkg-config libeigen3-dev libspectra-dev file || exit 0
unset CMAKE_C_COMPILER_LAUNCHER CMAKE_CXX_COMPILER_LAUNCHER  # zig has a cache of its own
fast="-O0 -fno-sanitize=undefined"  # zig's debug builds have the sanitizer
for processor in ${*:-aarch64 x86_64}; do
  triplet=$processor-macos folder=build-$processor-macos status=0
  mkdir -p "$folder"
  sh pkgconfig/zig.sh build-zig "$triplet" || status=$?
  if [ $status -eq 77 ]; then echo "skipped: macOS needs zig"; exit 0; fi
  [ $status -eq 0 ]
  tools=$PWD/build-zig/$triplet
  # CMake asks for programs of a Mac, of which an install alone would need one.
  set -- -DCMAKE_SYSTEM_NAME=Darwin -DCMAKE_SYSTEM_PROCESSOR="$processor" -DCMAKE_OSX_SYSROOT= \
    -DCMAKE_OSX_DEPLOYMENT_TARGET= -DCMAKE_INSTALL_NAME_TOOL=/bin/false -DCMAKE_AR="$tools/ar" \
    -DCMAKE_RANLIB="$tools/ranlib"
  JAM_LIBRARIES=zlib CC="$tools/cc" AR="$tools/ar" sh tests/platforms/dependencies.sh "$folder-libraries" "$triplet"
  configure "$folder" "$@" -DCMAKE_C_COMPILER="$tools/cc" -DCMAKE_CXX_COMPILER="$tools/c++" \
    -DCMAKE_UNITY_BUILD=ON -DCMAKE_C_FLAGS="$fast" -DCMAKE_CXX_FLAGS="$fast" -DJAM_BUILD_EXAMPLES=ON \
    -DSPECTRA_INCLUDE="$PWD/$folder-libraries/include" \
    -DJAM_BUILD_TESTS=OFF
  cmake --build "$folder" -j "$jobs" >"$folder/build.log" 2>&1 ||
    { grep -m 20 -E 'error|FAILED' "$folder/build.log"; exit 1; }
  made=$(find "$folder" -type f \( -name 'libjam.*.dylib' -o -name jam-pack -o -name 'example_*' \) -exec file {} + |
    grep -c 'Mach-O 64-bit') || true
  echo "$triplet: $made files of Mach-O, built, not run"
  [ "$made" -ge 10 ]
done
