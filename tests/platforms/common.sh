# Sourced by the scripts of this folder, in the root of the tree: packages, builds, tests and results of one platform.
. tests/debian.sh
jobs=${JAM_JOBS:-$(nproc)}
if command -v ccache >/dev/null; then export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache; fi

# Packages as of debian.sh, but a machine that cannot have them skips this part.
need_or_skip() {
  if (need_packages "$@") >/dev/null 2>&1; then return 0; fi
  echo "skipped: $* cannot all be installed here"
  return 1
}

# configure FOLDER OPTION...: the library that needs no other one, for d = 2 and 3.
configure() {
  folder=$1
  shift
  if [ -d "$folder-libraries" ]; then
    export PKG_CONFIG_LIBDIR="$PWD/$folder-libraries/lib/pkgconfig"
  else
    unset PKG_CONFIG_LIBDIR
  fi
  # Other platforms are compiled with -O1 and joined sources, each of which halves the time; neither changes a bit.
  cmake -S . -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=None -DCMAKE_C_FLAGS=-O1 -DCMAKE_CXX_FLAGS=-O1 \
    -DJAM_WERROR=ON -DJAM_LAPACK=OFF -DJAM_CLP=OFF \
    -DJAM_USE_VORO=OFF -DJAM_DIMENSIONS="2;3" -DJAM_BUILD_EXAMPLES=OFF -DCMAKE_UNITY_BUILD=ON "$@" \
    >"$folder/configure.log" 2>&1 ||
    { tail -20 "$folder/configure.log"; return 1; }
}

# The bits that every platform must have, and a jam-pack that writes files for others.
reference=$PWD/tests/platforms/bits.txt
native_files() {
  mkdir -p build-platform
  configure build-platform
  cmake --build build-platform -j "$jobs" --target jam-pack >build-platform/build.log
}

# begin_platform FOLDER NAME: its minutes count from now.
begin_platform() {
  mkdir -p "$1"
  rm -f "$1/result.json"
  platform=$2
  began=$(date +%s)
}

# same WORD FOLDER: whether the lines that begin with WORD are those of tests/platforms/bits.txt for d = 2 and 3.
same() {
  grep "^$1 " "$2/bits.txt" >"$2/bits.$1"
  grep "^$1 d=[23] " "$reference" | cmp -s - "$2/bits.$1" && echo same || echo other
}

# byte_order FOLDER: LITTLE_ENDIAN or BIG_ENDIAN, as CMake found the compiler's.
byte_order() { sed -n 's/^set(CMAKE_C_BYTE_ORDER "\(.*\)")/\1/p' "$1"/CMakeFiles/*/CMakeCCompiler.cmake; }

# build_platform FOLDER TARGET...
build_platform() {
  folder=$1
  shift
  cmake --build "$folder" -j "$jobs" --target "$@" >>"$folder/build.log" 2>&1 && return 0
  grep -E 'error|FAILED' "$folder/build.log" | head -20
  echo "$platform: $* does not compile"
  return 1
}

# Both write what they know into FOLDER/result.json.
write_result() {
  minutes=$((($(date +%s) - began + 59) / 60))
  {
    printf '{"platform": "%s", "passed": %d, "tests": %d, ' "$platform" "$passed" "$all"
    printf '"md": "%s", "crunch": "%s", "files": "%s", ' "$md" "$crunch" "$files"
    printf '"minutes": %d, "commit": "%s"}\n' "$minutes" "$(git rev-parse --short HEAD)"
  } >"$1/result.json"
}

# test_platform FOLDER: builds the library and compares bits and files, then builds and runs the tests. Fails where
# something does not compile, a bit or a file differs or a test fails. The tests take longest: JAM_PLATFORM_TESTS=quick
# runs those of this label, OFF none.
test_platform() {
  folder=$1 failed=0 passed=0 all=0
  : >"$folder/build.log"
  build_platform "$folder" jam_bits jam-pack || return 1
  emulator=$(sed -n 's/^CMAKE_CROSSCOMPILING_EMULATOR:[A-Z]*=//p' "$folder/CMakeCache.txt" | tr ';' ' ')
  end=
  if [ -f "$folder/jam-pack.exe" ]; then end=.exe; fi
  $emulator "$folder/tests/jam_bits$end" 2>"$folder/bits.log" | tr -d '\r' >"$folder/bits.txt"
  md=$(same md "$folder") crunch=$(same crunch "$folder")
  echo "bits of dynamics: $md, of crunches: $crunch"
  if [ "$md" != same ] || [ "$crunch" != same ]; then diff "$reference" "$folder/bits.txt" || failed=1; fi
  files=other order=same same=same
  if [ "$(byte_order "$folder")" != "$(byte_order build-platform)" ]; then
    order=other same="same, checkpoints refused"
  fi
  if sh tests/platforms/files.sh "$folder/files" "$order" "$PWD/build-platform/jam-pack" $emulator \
    "$PWD/$folder/jam-pack$end" 2>"$folder/files.log"; then files=$same; else failed=1; cat "$folder/files.log"; fi
  echo "files: $files"
  write_result "$folder"
  target=all label=.
  case ${JAM_PLATFORM_TESTS:-ON} in
    OFF) cat "$folder/result.json"; return $failed ;;
    quick) target=jam_quick label=quick ;;
  esac
  build_platform "$folder" $target || return 1
  # An emulator takes some twenty times longer.
  ctest --test-dir "$folder" -j "$jobs" -L 'unit|capi' -L "$label" -LE long --timeout 1800 --output-on-failure \
    --no-tests=error >"$folder/test.log" 2>&1 || failed=1
  sed -n '/tests passed/,$p' "$folder/test.log"
  passed=$(grep -c '   Passed ' "$folder/test.log") || true
  all=$(grep -cE 'Passed|\*\*\*(Failed|Timeout|Exception)' "$folder/test.log") || true
  write_result "$folder"
  cat "$folder/result.json"
  return $failed
}
