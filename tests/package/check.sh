#!/bin/sh
# check.sh PART BUILD PREFIX LIBDIR: installs the build into PREFIX, or checks one part of what is installed there.
set -eu
part=$1 build=$2 prefix=$3 libdir=$4
here=$(cd "$(dirname "$0")" && pwd)
scratch=$build/tests/package
die() { echo "$*" >&2; exit 1; }

case $part in
install)
  rm -rf "$prefix"
  cmake --install "$build" --prefix "$prefix" >"$scratch/install.log"
  grep -qx "libdir=$libdir" "$libdir/pkgconfig/jam.pc" || die "jam.pc does not name $libdir"
  for file in include/jam/jam.h bin/jam-pack share/licenses/libjam/LICENSE share/licenses/libjam/LINKED.md; do
    test -f "$prefix/$file" || die "$file is not installed"
  done
  ls "$libdir"/libjam.so.* >/dev/null
  ;;
pkgconfig)
  export PKG_CONFIG_PATH="$libdir/pkgconfig"
  pkg-config --exists jam || die "pkg-config does not find jam"
  grep -qx -- "-- pkg-config: PKG_CONFIG_PATH=$libdir/pkgconfig" "$scratch/install.log" ||
    die "the install does not print the folder of jam.pc"
  if grep '^Libs' "$libdir/pkgconfig/jam.pc" | grep ' /'; then die "jam.pc names a library by its path"; fi
  for package in jam jam-fortran; do
    [ -f "$libdir/pkgconfig/$package.pc" ] || continue
    if pkg-config --define-variable=includedir='/a b' --define-variable=libdir='/a b' --cflags --libs "$package" |
      grep '[^\\] b'; then die "$package.pc takes a folder with a blank for two"; fi
  done
  ;;
cmake)
  rm -rf "$scratch/consumer_cmake"
  cmake -S "$here/consumer" -B "$scratch/consumer_cmake" -DCMAKE_PREFIX_PATH="$prefix" >"$scratch/consumer_cmake.log"
  cmake --build "$scratch/consumer_cmake" >>"$scratch/consumer_cmake.log"
  "$scratch/consumer_cmake/consumer"
  if [ -f "$libdir/libjam.a" ]; then
    if ldd "$scratch/consumer_cmake/consumer_static" | grep -q libjam; then die "jam::static is the shared library"; fi
    "$scratch/consumer_cmake/consumer_static"
  fi
  ;;
subproject)
  # A part of another project, by FetchContent, beside targets of the same names. Without a build type the library is
  # optimised; the type and the flags of the parent are kept.
  flags() { grep '"command":.*/src/core/cell.cpp' "$scratch/fetch/compile_commands.json"; }
  configure() {
    rm -rf "$scratch/fetch"
    env -u CXXFLAGS -u CFLAGS cmake -G "Unix Makefiles" -S "$here/fetch" -B "$scratch/fetch" \
      -DJAM_SOURCE="$here/../.." -DCMAKE_EXPORT_COMPILE_COMMANDS=ON "$@" >"$scratch/fetch.log"
  }
  configure
  flags | grep -q -- ' -O3 ' || die "without a build type libjam is not optimised"
  grep -q 'no build type' "$scratch/fetch.log" || die "the flags are not reported"
  # An install of the parent has nothing of libjam, unless the parent asks for it.
  installed() { grep -rl 'file(INSTALL' --include=cmake_install.cmake "$scratch/fetch/_deps/jam-build" || true; }
  [ -z "$(installed)" ] || die "the parent installs libjam: $(installed)"
  configure -DCMAKE_CXX_FLAGS=-O1
  if flags | grep -q -- ' -O3 '; then die "the flags of the parent are not kept"; fi
  configure -DCMAKE_BUILD_TYPE=Debug -DJAM_INSTALL=ON -DJAM_BUILD_STATIC=ON
  if flags | grep -q -- ' -O3 '; then die "the build type of the parent is not kept"; fi
  [ -n "$(installed)" ] || die "JAM_INSTALL installs nothing"
  # Each links its own library.
  grep -q 'libjam[.]so' "$scratch/fetch/CMakeFiles/fetched.dir/link.txt" || die "jam::jam does not link libjam.so"
  grep 'libjam[.]a' "$scratch/fetch/CMakeFiles/fetched_static.dir/link.txt" | grep -v 'libjam[.]so' >/dev/null ||
    die "jam::static does not link libjam.a alone"
  ;;
preset)
  rm -rf "$scratch/flat"
  cmake -C "$here/../../pkgconfig/presets/flat.cmake" -S "$here/../.." -B "$scratch/flat" >"$scratch/flat.log"
  for value in 'JAM_LAPACK:STRING=OFF' 'JAM_CLP:BOOL=OFF' 'JAM_DIMENSIONS:STRING=2;3'; do
    grep -q "^$value\$" "$scratch/flat/CMakeCache.txt" || die "the preset flat does not set $value"
  done
  ;;
archive)
  # An archive of the source, which has no history, names its commit too.
  commit=$(git -C "$here/../.." rev-parse HEAD 2>/dev/null) || { echo "no repository"; exit 77; }
  rm -rf "$scratch/archive" && mkdir "$scratch/archive"
  git -C "$here/../.." archive HEAD | tar -x -C "$scratch/archive"
  cmake -S "$scratch/archive" -B "$scratch/archive/b" -DJAM_BUILD_TESTS=OFF -DCMAKE_EXPORT_COMPILE_COMMANDS=ON \
    >"$scratch/archive.log"
  grep '"command":.*/src/capi/status.cpp' "$scratch/archive/b/compile_commands.json" |
    grep -q "JAM_COMMIT_STRING=[^ ]*$(echo "$commit" | cut -c1-12)" || die "the archive does not name its commit"
  ;;
version)
  # The version and the ABI number of a release are set everywhere, and what earlier releases wrote stays. The tree
  # between two releases has a version of its own; recipes and citation keep the release.
  git -C "$here/../.." rev-parse HEAD >"$scratch/version.log" 2>&1 || { echo "no repository"; exit 77; }
  rm -rf "$scratch/version" && git clone -q --depth 1 "file://$(cd "$here/../.." && pwd)" "$scratch/version"
  cd "$scratch/version"
  step() {
    SOURCE_DATE_EPOCH=1800000000 /usr/bin/python3 -B pkgconfig/set_version.py . "$1" "$2"
    /usr/bin/python3 -B pkgconfig/recipes/check.py .
    wheel=$(PYTHONPATH=bindings/python /usr/bin/python3 -B -c 'import build_wheel; print(build_wheel._version())')
    [ "$wheel" = "$3" ] || die "the wheel of $1 is $wheel, not $3"
  }
  has() { grep -qxF -e "$2" "$1" || die "$1 has no line '$2'"; }
  first=$(head -1 pkgconfig/debian/changelog)
  step 97.1.0 1 97.1.0
  step 97.2.0-dev 1 97.2.0.dev0
  has .github/CITATION.cff 'version: 97.1.0'
  has .github/CITATION.cff 'date-released: 2027-01-15'
  has bindings/julia/Jam/Project.toml 'version = "97.2.0-dev"'
  step 98.76.54 7 98.76.54
  for entry in "$first" 'libjam (97.1.0-1) unstable; urgency=medium' 'libjam (98.76.54-1) unstable; urgency=medium'; do
    has pkgconfig/debian/changelog "$entry"
  done
  grep -qx ' -- The libjam authors <.*>  Fri, 15 Jan 2027 08:00:00 +0000' pkgconfig/debian/changelog ||
    die "the entry of the changelog has no date"
  if git -C "$scratch/version" grep -nE 'JAM_0\b|VERSION 0[.]1[.]0' -- src CMakeLists.txt pkgconfig/debian/control; then
    die "another version is left"
  fi
  ;;
uninstall)
  # What an install of the build wrote goes again, and nothing else.
  rm -rf "$scratch/gone"
  cmake --install "$build" --prefix "$scratch/gone" >"$scratch/uninstall.log"
  echo "of somebody else" >"$scratch/gone/include/other.h"
  cmake --build "$build" --target uninstall >>"$scratch/uninstall.log"
  left=$(find "$scratch/gone" ! -type d)
  [ "$left" = "$scratch/gone/include/other.h" ] || die "left or lost: $left"
  ;;
readme)
  # The C example of README.md is true.
  sed -n '/^```c$/,/^```$/p' "$here/../../README.md" | sed '/^```/d' >"$scratch/readme.c"
  test -s "$scratch/readme.c" || die "README.md has no C example"
  export PKG_CONFIG_PATH="$libdir/pkgconfig"
  ${CC:-cc} -std=c99 -Wall -Wextra -Werror "$scratch/readme.c" -o "$scratch/readme" $(pkg-config --cflags --libs jam)
  LD_LIBRARY_PATH=$libdir "$scratch/readme"
  ;;
symbols)
  # Which names are exported, and under which node: tests/abi.
  readelf -d "$libdir/libjam.so" | grep -q BIND_NOW || die "relocations stay writable (no -z now)"
  readelf -lW "$libdir/libjam.so" | grep -q GNU_RELRO || die "no RELRO segment"
  objdump -p "$libdir/libjam.so" | grep -q 'SONAME *libjam\.so\.[0-9]*$' || die "no SONAME with a number"
  # The list of licences names every library but the system's own.
  for library in $(readelf -d "$libdir/libjam.so" | sed -n 's/.*NEEDED.*\[lib\(.*\)[.]so.*/\1/p'); do
    case $library in
    c | m | gcc_s | stdc++) ;;
    z) grep -q '^| zlib |' "$here/../../pkgconfig/LINKED.md" || die "LINKED.md does not name zlib" ;;
    *) grep -q "^| .*$library.* |" "$here/../../pkgconfig/LINKED.md" -i || die "LINKED.md does not name $library" ;;
    esac
  done
  # A path of the build folder, which the identity of a program depends on, makes builds that cannot be compared.
  if readelf -d "$build/jam-pack" | grep 'RUNPATH' | grep -q "\[/\|:/"; then die "jam-pack names its build folder"; fi
  # The program must run from the installed tree without help from the environment.
  env -u LD_LIBRARY_PATH "$prefix/bin/jam-pack" --version
  ;;
*) die "unknown part $part" ;;
esac
