# Sourced by tests/run.sh and tests/fuzz/run.sh, from the root of the project: sanitize FOLDER OPTION... configures a
# build with the address and undefined-behaviour sanitizers, and sanitize_by_clang the one in build-asan, in which the
# fuzz targets are too. -O1 halves the compile time and keeps assertions. Molecular dynamics looks at all pairs for
# overlaps and at the order of events.
sanitize() {
  folder=$1; shift
  cmake -S . -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=None -DCMAKE_C_FLAGS=-O1 -DCMAKE_CXX_FLAGS=-O1 \
    -DJAM_SANITIZE=address,undefined -DJAM_CHECK_PAIRS=ON -DJAM_BUILD_EXAMPLES=OFF -DJAM_BUILD_CLI=OFF "$@" >/dev/null
  export UBSAN_OPTIONS=print_stacktrace=1
  export ASAN_OPTIONS=detect_stack_use_after_return=1
}
# Clang brings other warnings and another code generator than the release build, and takes a quarter less time with
# sanitizers; its linker takes half as long. One build serves the tests and the fuzz targets.
by_clang() {
  linker=; if command -v ld.lld >/dev/null; then linker=-fuse-ld=lld; fi
  echo -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_UNITY_BUILD=ON \
    "-DCMAKE_EXE_LINKER_FLAGS=$linker -DCMAKE_SHARED_LINKER_FLAGS=$linker"
}
sanitize_by_clang() {
  # shellcheck disable=SC2046
  sanitize build-asan $(by_clang) -DJAM_WERROR=ON -DJAM_FUZZ=ON
}
