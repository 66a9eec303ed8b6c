#!/bin/sh
# The library by Clang with LLVM's C++ library, which macOS has: unit tests, tests of the C interface, bits.
set -eu
cd "$(dirname "$0")/../.."
. tests/platforms/common.sh
need_or_skip clang libc++-dev libc++abi-dev ninja-build cmake pkg-config libeigen3-dev libspectra-dev zlib1g-dev \
  libcmocka-dev || exit 0
native_files
folder=build-libcxx
begin_platform "$folder" "Linux on $(uname -m), $(clang -dumpversion | sed 's/^/Clang /') and libc++"
configure "$folder" -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_CXX_FLAGS="-O1 -stdlib=libc++" \
  -DCMAKE_C_FLAGS=-O1
test_platform "$folder"
