#!/bin/sh
# macOS by zig's Clang: the library, jam-pack and the examples in C and C++ as Mach-O for both processors. Nothing is run.
set -eu
cd "$(dirname "$0")/../.."
. tests/platforms/common.sh
need_or_skip ninja-build cmake pkg-config libeigen3-dev libspectra-dev file || exit 0
for processor in ${*:-aarch64 x86_64}; do
  triplet=$processor-macos folder=build-$processor-macos
  mkdir -p "$folder"
  folder=$(cd "$folder" && pwd)
  sh pkgconfig/zig.sh build-zig "$triplet" || { [ $? -eq 77 ] && echo "skipped: macOS needs zig" && exit 0; exit 1; }
  tools=$PWD/build-zig/$triplet
  # CMake asks for two programs that a Mac has, and installs nothing here
  mac="-DCMAKE_SYSTEM_NAME=Darwin -DCMAKE_SYSTEM_PROCESSOR=$processor -DCMAKE_OSX_SYSROOT= -DCMAKE_OSX_DEPLOYMENT_TARGET=
    -DCMAKE_INSTALL_NAME_TOOL=/bin/false -DCMAKE_AR=$tools/ar -DCMAKE_RANLIB=$tools/ranlib"
  JAM_LIBRARIES=zlib CC="$tools/cc" AR="$tools/ar" sh tests/platforms/dependencies.sh "build-$triplet-libraries" "$triplet" $mac
  configure "build-$triplet" $mac -DCMAKE_C_COMPILER="$tools/cc" -DCMAKE_CXX_COMPILER="$tools/c++" \
    -DCMAKE_UNITY_BUILD=ON -DSPECTRA_INCLUDE="$PWD/build-$triplet-libraries/include" -DJAM_BUILD_EXAMPLES=ON \
    -DJAM_BUILD_TESTS=OFF
  cmake --build "build-$triplet" -j "$jobs" >"$folder/build.log" 2>&1 || { grep -m 20 -E 'error|FAILED' "$folder/build.log"; exit 1; }
  made=$(find "$folder" -type f \( -name 'libjam.*.dylib' -o -name jam-pack -o -name 'example_*' \) -exec file {} + |
    grep -c 'Mach-O 64-bit') || true
  nm=$(command -v llvm-nm || ls /usr/bin/llvm-nm-[0-9]* 2>/dev/null | tail -1)
  echo "$triplet: $made files of Mach-O, library $(stat -c %s "$folder"/libjam.*.*.dylib) bytes"
done
